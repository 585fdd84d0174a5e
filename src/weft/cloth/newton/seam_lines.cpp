#include "weft/cloth/newton/seam_lines.h"

#include <algorithm>

namespace weft {
namespace {

/// The edges of a sample along its row or column, where there are any.
std::array<BorderEdge, 2> edges_at(int size, int sample, bool along_row) {
  const int row = sample / size, col = sample % size;
  return {BorderEdge{along_row, along_row ? row : row - 1, along_row ? col - 1 : col},
          BorderEdge{along_row, row, col}};
}

bool contains(std::span<const BorderEdge> edges, const BorderEdge& edge) {
  return std::find(edges.begin(), edges.end(), edge) != edges.end();
}

using Block = std::array<double, block_entries>;

void add(const PlaneSet& blocks, int row, int col, Block& sum) {
  for (int k = 0; k < block_entries; ++k) sum[k] += double{blocks(row, col, k)};
}

/// Adds t 1 + s s^T.
void add_spring(const PlaneSet& near, const BorderEdge& edge, Block& sum) {
  const int first = (edge.along_row ? 0 : 1) * spring_entries;
  const auto entry = [&](int k) { return double{near(edge.row, edge.col, first + k)}; };
  const double t = entry(0), x = entry(1), y = entry(2), z = entry(3);
  const Block block{t + x * x, x * y, x * z, t + y * y, y * z, t + z * z};
  for (int k = 0; k < block_entries; ++k) sum[k] += block[k];
}

}  // namespace

SeamLines::SeamLines(const Seams& seams, std::span<const std::vector<BorderEdge>> joined) {
  const int n = seams.size();
  for (int i = 0; i < seams.class_count(); ++i)
    for (const bool along_row : {true, false}) {
      const int first = seams.samples(i).front();
      std::vector<BorderEdge> on_line;
      for (const BorderEdge& edge : edges_at(n, first, along_row))
        for (const std::vector<BorderEdge>& group : joined)
          if (contains(group, edge)) on_line.insert(on_line.end(), group.begin(), group.end());
      Line line{first, along_row, static_cast<int>(parts_.size()), 0};
      for (const int s : seams.samples(i).subspan(1)) parts_.push_back(part_of(n, s, on_line));
      line.end = static_cast<int>(parts_.size());
      lines_.push_back(line);
    }
}

/// Where a seam turns, springs of a copy's row and column may both be on the line: then those of
/// the column count twice, which holds the particle too firmly but leaves the line definite.
SeamLines::Part SeamLines::part_of(int size, int sample, std::span<const BorderEdge> joined) {
  Part part{sample};
  const auto on_line = [&](const BorderEdge& edge) { return contains(joined, edge); };
  const std::array along = edges_at(size, sample, true), down = edges_at(size, sample, false);
  part.of_rows = std::any_of(along.begin(), along.end(), on_line) ||
                 std::none_of(down.begin(), down.end(), on_line);
  for (const BorderEdge& edge : part.of_rows ? along : down)
    if (!on_line(edge)) part.springs[part.count++] = edge;
  return part;
}

void SeamLines::hold_line(const Line& line, const SpringHessian& springs, BlockLevel& level) const {
  const int n = level.size;
  PlaneSet& held = line.along_row ? level.held_rows : level.held_cols;
  Block sum{};
  add(held, line.first / n, line.first % n, sum);
  for (const Part& part : std::span(parts_).subspan(line.begin, line.end - line.begin)) {
    add(part.of_rows ? level.held_rows : level.held_cols, part.sample / n, part.sample % n, sum);
    for (int k = 0; k < part.count; ++k) add_spring(springs.near(), part.springs[k], sum);
  }
  for (int k = 0; k < block_entries; ++k)
    held(line.first / n, line.first % n, k) = static_cast<float>(sum[k]);
}

void SeamLines::hold(const SpringHessian& springs, BlockLevel& level,
                     const Workers& workers) const {
  const Range mine = workers.share(static_cast<int>(lines_.size()) / 2);
  for (int i = 2 * mine.first; i < 2 * mine.last; i += 2) {
    for (const int k : {i, i + 1}) hold_line(lines_[k], springs, level);
    for (int p = lines_[i].begin; p < lines_[i].end; ++p)
      for (const int k : {0, 3, 5})
        for (PlaneSet* held : {&level.held_rows, &level.held_cols})
          (*held)(parts_[p].sample / level.size, parts_[p].sample % level.size, k) =
              holding_stiffness;
  }
}

}  // namespace weft

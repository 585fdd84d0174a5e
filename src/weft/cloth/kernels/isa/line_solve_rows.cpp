#include "weft/cloth/kernels/isa/line_tiles.h"
#include "weft/cloth/kernels/isa/rows.h"

// Block tridiagonal systems of neighbouring lines, solved side by side in lanes with their factors.
namespace weft::WEFT_KERNEL_SET {
namespace {

/// A vector of a pack of lanes. @param planes  x, y and z, `lanes` floats apart
template <int Lanes>
[[gnu::always_inline]] inline Pack3 load_lanes(const float* planes) {
  return {load(planes), load(planes + Lanes), load(planes + 2 * Lanes)};
}
template <int Lanes>
[[gnu::always_inline]] inline void store_lanes(const Pack3& v, float* planes) {
  store(v.x, planes);
  store(v.y, planes + Lanes);
  store(v.z, planes + 2 * Lanes);
}

/// G v, for the inverse blocks of a position.
template <int Lanes>
[[gnu::always_inline]] inline Pack3 block_times(const float* block, const Pack3& v) {
  const Pack xy = load(block + Lanes), xz = load(block + 2 * Lanes), yz = load(block + 4 * Lanes);
  return {load(block) * v.x + xy * v.y + xz * v.z,
          xy * v.x + load(block + 3 * Lanes) * v.y + yz * v.z,
          xz * v.x + yz * v.y + load(block + 5 * Lanes) * v.z};
}

/// What a sample pulls its neighbour by: -B v for coupling blocks, t v + s (s . v) for springs.
struct BlockPull {
  static constexpr int entries = line_factor_entries;
  template <int Lanes>
  [[gnu::always_inline]] static Pack3 of(const float* block, const Pack3& v) {
    const Pack3 none{};
    return none - block_times<Lanes>(block, v);
  }
};
struct SpringPull {
  static constexpr int entries = held_factor_entries;
  template <int Lanes>
  [[gnu::always_inline]] static Pack3 of(const float* spring, const Pack3& v) {
    const Pack3 s{load(spring + Lanes), load(spring + 2 * Lanes), load(spring + 3 * Lanes)};
    return load(spring) * v + dot(s, v) * s;
  }
};

/// A block of lines during elimination and substitution, with what one position passes to the next.
template <int Lanes, class Pull>
struct LineElimination {
  static constexpr std::ptrdiff_t entries = std::ptrdiff_t{Pull::entries} * Lanes;
  /// Packs that are worked on in turn: a lone one would wait for its own results.
  static constexpr int packs = Lanes / width < 2 ? Lanes / width : 2;

  const float* factors;
  float* scratch;
  alignas(64) float tile[3][chunk][Lanes];
  alignas(64) float passed[3][Lanes];

  /// Eliminates positions first .. first + count - 1 of lanes i on.
  [[gnu::always_inline]] void eliminate(int first, int count, int i) {
    Pack3 pull[packs];
    for (int p = 0; p < packs; ++p) pull[p] = load_lanes<Lanes>(&passed[0][i + p * width]);
    for (int j = 0; j < count; ++j)
      for (int p = 0; p < packs; ++p) {
        const int lane = i + p * width;
        const float* const block = factors + (first + j) * entries + lane;
        const Pack3 rhs{load(&tile[0][j][lane]), load(&tile[1][j][lane]), load(&tile[2][j][lane])};
        const Pack3 here = block_times<Lanes>(block, rhs + pull[p]);
        store_lanes<Lanes>(here, scratch + std::ptrdiff_t{first + j} * 3 * Lanes + lane);
        pull[p] = Pull::template of<Lanes>(block + 6 * Lanes, here);
      }
    for (int p = 0; p < packs; ++p) store_lanes<Lanes>(pull[p], &passed[0][i + p * width]);
  }

  /// The same backwards; the tile gets the scaled solution.
  [[gnu::always_inline]] void substitute(int first, int count, int i, Pack scale) {
    Pack3 later[packs];
    for (int p = 0; p < packs; ++p) later[p] = load_lanes<Lanes>(&passed[0][i + p * width]);
    for (int j = count - 1; j >= 0; --j)
      for (int p = 0; p < packs; ++p) {
        const int lane = i + p * width;
        const float* const block = factors + (first + j) * entries + lane;
        const Pack3 pull = Pull::template of<Lanes>(block + 6 * Lanes, later[p]);
        const Pack3 here =
            load_lanes<Lanes>(scratch + std::ptrdiff_t{first + j} * 3 * Lanes + lane);
        later[p] = here + block_times<Lanes>(block, pull);
        store(scale * later[p].x, &tile[0][j][lane]);
        store(scale * later[p].y, &tile[1][j][lane]);
        store(scale * later[p].z, &tile[2][j][lane]);
      }
    for (int p = 0; p < packs; ++p) store_lanes<Lanes>(later[p], &passed[0][i + p * width]);
  }
};

template <int Lanes, class Pull>
void solve(const LineBlock& block, const LineSolve& how) {
  using Solve = LineElimination<Lanes, Pull>;
  Solve state;
  state.factors = how.factor;
  state.scratch = how.scratch;
  if (block.width < Lanes) __builtin_memset(state.tile, 0, sizeof state.tile);
  __builtin_memset(state.passed, 0, sizeof state.passed);
  constexpr int step = Solve::packs * width;
  for (int position = 0; position < block.length; position += chunk) {
    const int count = block.length - position < chunk ? block.length - position : chunk;
    for (int k = 0; k < 3; ++k) read_tile<Lanes>(how.rhs[k], block, position, count, state.tile[k]);
    for (int i = 0; i < Lanes; i += step) state.eliminate(position, count, i);
  }
  __builtin_memset(state.passed, 0, sizeof state.passed);
  const int last = (block.length - 1) / chunk * chunk;
  for (int position = last; position >= 0; position -= chunk) {
    const int count = block.length - position < chunk ? block.length - position : chunk;
    for (int i = 0; i < Lanes; i += step) state.substitute(position, count, i, Pack{} + how.scale);
    for (int k = 0; k < 3; ++k)
      write_tile<Lanes>(how.out[k], block, position, count, state.tile[k], how.add);
  }
}

}  // namespace

void solve_lines(const LineBlock& lines, const LineSolve& how) {
  if (lines.width > half_lanes)
    solve<line_lanes, BlockPull>(lines, how);
  else
    solve<half_lanes, BlockPull>(lines, how);
}

void solve_held_lines(const LineBlock& lines, const LineSolve& how) {
  if (lines.width > half_lanes)
    solve<line_lanes, SpringPull>(lines, how);
  else
    solve<half_lanes, SpringPull>(lines, how);
}

}  // namespace weft::WEFT_KERNEL_SET

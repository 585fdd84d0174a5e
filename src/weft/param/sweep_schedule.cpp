#include "weft/param/sweep_schedule.h"

#include <algorithm>

namespace weft {
namespace {

/// [V] the group of each inner vertex, -1 of others.
std::vector<int> groups_of(const CollapseHierarchy& mesh) {
  std::vector<int> group(mesh.vertex_count(), -1);
  for (int v = 0; v < mesh.vertex_count(); ++v) {
    if (!mesh.is_inner(v)) continue;
    int last = -1;
    mesh.around(v, [&](int h) {
      if (mesh.to(h) < v) last = std::max(last, group[mesh.to(h)]);
    });
    group[v] = last + 1;
  }
  return group;
}

}  // namespace

SweepSchedule schedule_sweep(const CollapseHierarchy& mesh) {
  SweepSchedule schedule;
  const std::vector<int> group = groups_of(mesh);
  if (group.empty()) return schedule;
  schedule.first.assign(*std::max_element(group.begin(), group.end()) + 2, 0);
  for (const int g : group)
    if (g >= 0) ++schedule.first[g + 1];
  for (int g = 0; g < schedule.group_count(); ++g) schedule.first[g + 1] += schedule.first[g];
  schedule.vertices.resize(schedule.first.back());
  std::vector<int> next(schedule.first.begin(), schedule.first.end() - 1);
  for (int v = 0; v < mesh.vertex_count(); ++v) {
    if (group[v] < 0) continue;
    schedule.vertices[next[group[v]]++] = v;
    schedule.largest_valence = std::max(schedule.largest_valence, mesh.valence(v));
  }
  return schedule;
}

}  // namespace weft

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdlib>
#include <new>

#include <gtest/gtest.h>

#include "tests/cloth/sheets.h"
#include "tests/collide/test_bodies.h"
#include "weft/cloth/baselines/coarse_limit.h"
#include "weft/cloth/baselines/strain_limit.h"
#include "weft/cloth/integrator.h"
#include "weft/cloth/wind.h"
#include "weft/collide/collider.h"
#include "weft/collide/contacts/contact_response.h"

// The whole program's allocations are counted: the standard lets a program replace these.

namespace {

std::atomic<long> allocations{0};

void* counted_memory(std::size_t size, std::size_t alignment) {
  ++allocations;
  const std::size_t rounded = (std::max<std::size_t>(size, 1) + alignment - 1) / alignment;
  if (void* memory = std::aligned_alloc(alignment, rounded * alignment)) return memory;
  throw std::bad_alloc();
}

}  // namespace

// Where the compiler inlines only one of a pair, it takes free() for the wrong end of the other.
#pragma GCC diagnostic ignored "-Wmismatched-new-delete"
void* operator new(std::size_t size) { return counted_memory(size, alignof(std::max_align_t)); }
void* operator new(std::size_t size, std::align_val_t alignment) {
  return counted_memory(size, static_cast<std::size_t>(alignment));
}
// As of std::stable_sort; the default calls the one above, but for that of a sanitizer.
void* operator new(std::size_t size, const std::nothrow_t& /*tag*/) noexcept try {
  return counted_memory(size, alignof(std::max_align_t));
} catch (const std::bad_alloc&) {
  return nullptr;
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, const std::nothrow_t& /*tag*/) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t /*size*/) noexcept { std::free(memory); }
void operator delete(void* memory, std::align_val_t /*alignment*/) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t /*size*/, std::align_val_t /*alignment*/) noexcept {
  std::free(memory);
}

namespace weft {
namespace {

using namespace testing;

struct Step {
  const Cloth& cloth;
  Integrator& integrator;
  Wind& wind;
  CoarseLimit& coarse;
  StrainLimit& limit;
  Collider& collider;
  ThreadTeam& team;

  void take(const StepInput& input, ClothState& state) const {
    wind.blow(input.time_step, state, team);
    integrator.begin(input, state);
    ClothState* next = &integrator.iterate({});
    const MovingCloth moving{state.position, next->position, next->velocity, cloth.inverse_mass};
    collider.detect(std::span(&moving, 1), input.time_step, team);
    next = &integrator.iterate(collider.contacts(0));
    coarse.limit({.passes = 2, .strain = 0.05}, input.time_step, *next, team);
    limit.limit({.strain = 0.05}, input.time_step, *next, team);
    collider.correct(0, moving, integrator.contact_forces(), input.time_step, team);
    collider.filter(std::span(&moving, 1), input.time_step, team);
    integrator.end(state);
  }
};

TEST(Allocation, CounterCounts) {
  const long before = allocations;
  const Planes3 planes(9);
  EXPECT_GE(allocations - before, 3);
}

TEST(Allocation, SteppingAllocatesNothingOnceWarm) {
  const int n = 17;
  for (const IntegratorOptions& options :
       {IntegratorOptions(ImplicitOptions{}), IntegratorOptions(ExplicitOptions{}),
        IntegratorOptions(TwoLevelOptions{.local_size = 5}), IntegratorOptions(MultigridOptions{}),
        IntegratorOptions(DesbrunOptions{})})
    for (Cloth cloth : {sheet_cloth(n), torus_cloth(n)}) {
      pin(cloth, 0, vec_cast<double>(cloth.rest.at(0)));
      ThreadTeam team(2);
      const StepInput input{1e-4, {0, -9.81F, 0}};
      const auto integrator = make_integrator(options, cloth, input, team);
      const Obstacles ball{{test::octahedral_sphere(17, 0.3, {0, -0.35, 0})}, -0.5, 0.5};
      const auto collider = test::polar_collider(ball, 0.002, 0.4);
      Wind wind({{1, 2, 0}}, cloth);
      CoarseLimit coarse(cloth, team);
      StrainLimit limit(cloth, team);
      ClothState state = rest_state(cloth, {0, -1, 0});
      shake(cloth, 0.02, state.position);
      const Step step{cloth, *integrator, wind, coarse, limit, *collider, team};
      step.take(input, state);
      const long before = allocations;
      for (int i = 0; i < 5; ++i) step.take(input, state);
      EXPECT_EQ(allocations - before, 0) << name_of(options);
    }
}

TEST(Allocation, UntanglingAllocatesNothingOnceWarm) {
  const int n = 17;
  Cloth cloth = sheet_cloth(n);
  // A strip like an eight, held where it is.
  Planes3 start(n), velocity(n);
  for (int r = 0; r < n; ++r)
    for (int c = 0; c < n; ++c) {
      const double t = 0.4 * (c - 4);
      start.set(r, c, vec_cast<float>(Vec3d{sine(t), 0.5 * sine(2 * t), 0.1 * r + 0.02 * c}));
      cloth.inverse_mass(r, c) = 0;
    }
  const CollidingCloth statistics{
      .mates = cloth.mates, .size = n, .rest_spacing = 0.1, .self_collision = true};
  const auto collider = make_collider(PyramidOptions{}, {}, std::span(&statistics, 1));
  ThreadTeam team(2);
  Planes3 position = start;
  const MovingCloth moving{start, position, velocity, cloth.inverse_mass};
  const auto step = [&] {
    collider->detect(std::span(&moving, 1), 1e-3, team);
    collider->filter(std::span(&moving, 1), 1e-3, team);
  };
  step();
  step();  // which asks for pairs of the first again, in another order
  const long before = allocations;
  for (int i = 0; i < 5; ++i) step();
  EXPECT_EQ(allocations - before, 0);
  EXPECT_GT(collider->crossings(), 0);
}

/// Each particle of a row against a triangle two rows farther on, and all against a floor.
std::vector<Contact> contacts_of(const Cloth& cloth) {
  const int n = cloth.size;
  const Vec3f up{0, 1, 0};
  std::vector<Contact> contacts;
  for (int s = 0; s < n * (n - 4); ++s) {
    const int at = s + 2 * n;
    contacts.push_back({{s, at, at + 1, at + n}, {1, -0.5F, -0.3F, -0.2F}, up, -0.001F, 0.4F, {}});
    contacts.push_back({{s}, {1}, up, cloth.rest.at(s).y, 0.4F, {}});
  }
  return contacts;
}

TEST(Allocation, SolvingForContactsAllocatesNothingOnceWarm) {
  const int n = 17;
  for (const Cloth& cloth : {sheet_cloth(n), torus_cloth(n)}) {
    ThreadTeam team(2);
    const StepInput input;
    const auto integrator = make_integrator(MultigridOptions{}, cloth, input, team);
    ContactResponse response(cloth.mates);
    const std::vector<Contact> contacts = contacts_of(cloth);
    ClothState state = rest_state(cloth);
    int touched = 0;
    const auto step = [&] {
      integrator->begin(input, state);
      ClothState& next = integrator->iterate(contacts);
      const MovingCloth moving{state.position, next.position, next.velocity, cloth.inverse_mass};
      touched +=
          response.respond(moving, {contacts, integrator->contact_forces()}, input.time_step, team);
      integrator->end(state);
    };
    step();
    const long before = allocations;
    for (int i = 0; i < 5; ++i) step();
    EXPECT_EQ(allocations - before, 0);
    EXPECT_GT(touched, 0);
  }
}

TEST(Allocation, GuardingAllocatesNothingOnceWarm) {
  const int n = 17;
  const Cloth cloth = sheet_cloth(n);
  const Obstacles bodies{{test::octahedral_sphere(17, 0.3, {0, -0.35, 0}),
                          test::octahedron(17, {0.2, 0.3, 0.2}, {0.2, -0.35, 0.2})},
                         -0.5,
                         0.5};
  const CollidingCloth statistics{
      .mates = cloth.mates, .size = n, .rest_spacing = cloth.rest_spacing, .self_collision = true};
  const auto collider = make_collider(PyramidOptions{}, bodies, std::span(&statistics, 1));
  ThreadTeam team(2);
  ClothState start = rest_state(cloth), next = rest_state(cloth);
  shake(cloth, 0.02, start.position);
  const auto step = [&] {
    next = start;
    for (int s = 0; s < n * n; ++s)
      next.position.set(s, start.position.at(s) + Vec3f{0, -0.08F, 0.001F * (s % 7)});
    const MovingCloth moving{start.position, next.position, next.velocity, cloth.inverse_mass};
    collider->detect(std::span(&moving, 1), 1.0 / 240, team);
    collider->correct(0, moving, {}, 1.0 / 240, team);
    collider->filter(std::span(&moving, 1), 1.0 / 240, team);
    return collider->contacts(0).size();
  };
  EXPECT_GT(step(), 10U);
  step();
  const long before = allocations;
  for (int i = 0; i < 5; ++i) step();
  EXPECT_EQ(allocations - before, 0);
}

}  // namespace
}  // namespace weft

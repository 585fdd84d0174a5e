#include "weft/cloth/newton/contact_product.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/cloth/sheets.h"
#include "weft/core/random.h"

namespace weft {
namespace {

using testing::sheet_cloth;
using testing::torus_cloth;
using Spring = ContactProduct::Spring;

/// Two cloths, one of them with mates, and springs by chance on them.
class SprungCloths {
 public:
  static constexpr int n = 9, springs = 23;
  SprungCloths() {
    for (PaddedVectors& field : fields_)
      for (int s = 0; s < n * n; ++s) set(field, s, {chance(), chance(), chance()});
    for (int s = 0; s < n * n; ++s) {
      const int first = torus_.mates.representative(s);
      set(fields_[0], s, at(fields_[0], first));
    }
    product_.clear();
    for (int i = 0; i < springs; ++i) product_.add(springs_.emplace_back(some_spring(i)));
    product_.finish();
    const std::array<const PaddedVectors*, 2> fields{&fields_[0], &fields_[1]};
    ThreadTeam team(2);
    team.run([&](Worker& worker) { product_.multiply(fields, worker); });
  }

  /// The displacement of a spring's point, and its load by the formula.
  [[nodiscard]] Vec3d load_of(const Spring& spring) const {
    Vec3d moved;
    for (std::size_t k = 0; k < 4; ++k)
      moved +=
          double{spring.weights[k]} * vec_cast<double>(at(field_of(spring, k), spring.samples[k]));
    const Vec3d n_ = vec_cast<double>(spring.normal);
    return (double{spring.stiffness} - spring.grip) * dot(n_, moved) * n_ +
           double{spring.grip} * moved;
  }
  /// What a sample gets of all loads: of a class of mates each an equal part.
  [[nodiscard]] Vec3d expected(std::size_t cloth, int sample) const {
    const Cloth& of = *cloths_[cloth];
    const int copies = copies_of(of, sample);
    Vec3d sum;
    for (const Spring& spring : springs_)
      for (std::size_t k = 0; k < 4; ++k)
        if (cloth_of(spring, k) == cloth &&
            of.mates.representative(spring.samples[k]) == of.mates.representative(sample))
          sum += (double{spring.weights[k]} / copies) * load_of(spring);
    return sum;
  }
  [[nodiscard]] Vec3d found(std::size_t cloth, int sample) const {
    PaddedVectors out(n, n);
    product_.add_row(cloth, sample / n, 1, out.row(sample / n));
    return vec_cast<double>(at(out, sample));
  }
  /// x^T A x by the blocks of all samples, and by the springs.
  [[nodiscard]] double by_blocks() const {
    double sum = 0;
    for (std::size_t cloth = 0; cloth < 2; ++cloth)
      for (int row = 0; row < n; ++row)
        product_.for_blocks(cloth, row, [&](int col, const ContactProduct::Blocks& blocks) {
          const Vec3d x = vec_cast<double>(at(fields_[cloth], row * n + col));
          const auto& [xx, xy, xz, yy, yz, zz] = blocks.whole;
          sum += xx * x.x * x.x + yy * x.y * x.y + zz * x.z * x.z +
                 2 * (xy * x.x * x.y + xz * x.x * x.z + yz * x.y * x.z);
        });
    return sum;
  }
  [[nodiscard]] double by_springs() const {
    double sum = 0;
    for (const Spring& spring : springs_)
      for (std::size_t k = 0; k < 4; ++k)
        sum += double{spring.weights[k]} *
               dot(vec_cast<double>(at(field_of(spring, k), spring.samples[k])), load_of(spring));
    return sum;
  }

 private:
  static std::size_t cloth_of(const Spring& spring, std::size_t k) {
    return static_cast<std::size_t>(spring.cloths[spring.weights[k] < 0 ? 1 : 0]);
  }
  [[nodiscard]] const PaddedVectors& field_of(const Spring& spring, std::size_t k) const {
    return fields_[cloth_of(spring, k)];
  }
  static int copies_of(const Cloth& cloth, int sample) {
    int copies = 0;
    for (int s = 0; s < n * n; ++s)
      copies += cloth.mates.representative(s) == cloth.mates.representative(sample) ? 1 : 0;
    return copies;
  }
  static Vec3f at(const PaddedVectors& field, int s) {
    return {field.x(s / n, s % n), field.y(s / n, s % n), field.z(s / n, s % n)};
  }
  static void set(PaddedVectors& field, int s, Vec3f value) {
    field.x(s / n, s % n) = value.x;
    field.y(s / n, s % n) = value.y;
    field.z(s / n, s % n) = value.z;
  }
  float chance() { return static_cast<float>(random_.uniform(-1, 1)); }
  /// Of the first cloth, of the second, or between them; with an obstacle or within cloth.
  Spring some_spring(int i) {
    Spring spring;
    for (int& sample : spring.samples) sample = random_.index(n * n);
    const bool within = i % 2 == 0;
    spring.weights =
        within ? std::array{0.7F, 0.3F, -0.6F, -0.4F} : std::array{0.5F, 0.3F, 0.2F, 0.0F};
    spring.normal = vec_cast<float>(normalized(Vec3d{chance(), chance(), 1.5}));
    spring.stiffness = 1000 + 100 * chance();
    spring.grip = i % 3 == 0 ? 0 : 200 + 50 * chance();
    const int first = i / 8 % 2;
    spring.cloths = {first, within && i > 15 ? 1 - first : first};
    return spring;
  }

  Random random_{11};
  Cloth torus_ = torus_cloth(n), sheet_ = sheet_cloth(n);
  std::array<const Cloth*, 2> cloths_{&torus_, &sheet_};
  std::array<PaddedVectors, 2> fields_{PaddedVectors(n, n), PaddedVectors(n, n)};
  ContactProduct product_{cloths_};
  std::vector<Spring> springs_;
};

TEST(ContactProduct, LoadsAreThoseOfItsSprings) {
  const SprungCloths cloths;
  for (std::size_t cloth = 0; cloth < 2; ++cloth)
    for (int s = 0; s < SprungCloths::n * SprungCloths::n; ++s)
      EXPECT_NEAR(length(cloths.found(cloth, s) - cloths.expected(cloth, s)), 0, 2e-3)
          << cloth << ": " << s;
}

TEST(ContactProduct, BlocksAreNoLessThanItsSprings) {
  const SprungCloths cloths;
  EXPECT_GT(cloths.by_springs(), 1000);
  EXPECT_GE(cloths.by_blocks(), cloths.by_springs());
}

}  // namespace
}  // namespace weft

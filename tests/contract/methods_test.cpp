// What a new method touches: its struct, which tells all that others need to know of it.
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "weft/colliders.h"
#include "weft/integrators.h"

namespace weft {
namespace {

struct ToyOptions {
  int steps = 3;
  double softness = 0.5;
  bool springs = true;

  static constexpr std::string_view name = "toy";
  static constexpr IntegratorTraits traits{.has_limiter = true, .bytes_per_sample = 10};
  template <class Visit>
  static void visit_options(const Visit& visit) {
    visit("steps", &ToyOptions::steps, OptionRange{1, 9});
    visit("softness", &ToyOptions::softness, OptionRange{0});
    visit("springs", &ToyOptions::springs, OptionRange{});
  }
};
using Toys = Methods<std::variant<NewtonOptions, ToyOptions>>;

TEST(Methods, ANewOneIsListedAndFoundByItsName) {
  EXPECT_EQ(Toys::names(), (std::vector<std::string_view>{"newton", "toy"}));
  const auto found = Toys::find("toy");
  ASSERT_TRUE(found);
  EXPECT_EQ(Toys::name_of(*found), "toy");
  EXPECT_EQ(std::get<ToyOptions>(*found).steps, 3);
  EXPECT_FALSE(Toys::find("toys"));
}

TEST(Methods, TraitsAreThoseOfTheMethodThatIsHeld) {
  EXPECT_EQ(Toys::traits_of(ToyOptions{}).bytes_per_sample, 10);
  EXPECT_FALSE(Toys::traits_of(NewtonOptions{}).has_limiter);
  EXPECT_TRUE(Colliders::traits_of(PyramidOptions{}).filters);
  EXPECT_FALSE(Colliders::traits_of(PolarMapOptions{}).filters);
}

TEST(Methods, OptionsAreVisitedByTheirKeys) {
  std::string keys;
  double sum = 0;
  ToyOptions toy{4, 0.25, true};
  ToyOptions::visit_options([&](std::string_view key, auto member, OptionRange range) {
    keys.append(key).append(" ");
    sum += toy.*member + (range.max == 9 ? 100 : 0);
  });
  EXPECT_EQ(keys, "steps softness springs ");
  EXPECT_EQ(sum, 105.25);
}

TEST(Methods, TheDefaultsComeFirst) {
  EXPECT_EQ(Integrators::names().front(), name_of(IntegratorOptions{}));
  EXPECT_EQ(Colliders::names().front(), name_of(ColliderOptions{}));
}

}  // namespace
}  // namespace weft

#include <gtest/gtest.h>

#include "tests/support/errors.h"
#include "weft/core/math.h"
#include "weft/error.h"
#include "weft/fabric.h"

namespace weft {
namespace {

/// Small, few and in long steps, so that a test is short; accurate, whatever the default is.
DrapeTestOptions quick() {
  DrapeTestOptions options;
  options.size = 17;
  options.starts = 2;
  options.time_step = 1.0 / 60;
  options.seconds = 3;
  options.integrator = ImplicitOptions{};
  return options;
}

TEST(DrapeCoefficient, StiffDiscStaysFlat) {
  const DrapeResult result = measure_drape({.bending = 1}, quick());
  EXPECT_NEAR(result.coefficient, 1, 0.01);
  EXPECT_LT(result.spread, 0.001);
  EXPECT_EQ(result.folds(), 0);
}

TEST(DrapeCoefficient, StifferFabricsDrapeLess) {
  double last = 0;
  for (const double bending : {2e-6, 2e-5, 2e-4}) {
    const DrapeResult result = measure_drape({.density = 0.2, .bending = bending}, quick());
    EXPECT_GT(result.coefficient, last + 0.1) << bending;
    EXPECT_LT(result.coefficient, 1) << bending;
    if (bending < 1e-4) {
      EXPECT_GE(result.folds(), 2) << bending;
    }
    last = result.coefficient;
  }
}

TEST(DrapeCoefficient, DiscsComeToRest) {
  DrapeTestOptions options;
  options.size = 17;
  options.starts = 2;
  const DrapeResult result = measure_drape({.density = 0.2, .bending = 2e-5}, options);
  // A billionth of what the disc would gain by falling as far as it is wide.
  const double mass = 0.2 * pi * 0.15 * 0.15;
  EXPECT_LT(result.kinetic_energy, 1e-9 * mass * 9.81 * 0.3);
}

TEST(DrapeCoefficient, IsTheSameOnFinerImages) {
  // Stiff, so that there is one shape to come to: it droops by the fourth power of its overhang.
  DrapeTestOptions options;
  options.starts = 1;
  const auto drooped = [&](int size) {
    options.size = size;
    return 1 - measure_drape({.density = 0.2, .bending = 3e-4}, options).coefficient;
  };
  const double coarse = drooped(33), fine = drooped(65);
  EXPECT_GT(fine, 0.005);
  EXPECT_NEAR(coarse, fine, 0.06 * fine);
}

TEST(DrapeCoefficient, DependsOnBendingOverWeightAlone) {
  // Twice the mass and twice the stiffness of everything move alike.
  const DrapeResult one =
      measure_drape({.density = 0.1, .stretch = 1e4, .shear = 50, .bending = 1e-5}, quick());
  const DrapeResult two =
      measure_drape({.density = 0.2, .stretch = 2e4, .shear = 100, .bending = 2e-5}, quick());
  EXPECT_NEAR(one.coefficient, two.coefficient, 0.01);
}

TEST(DrapeCoefficient, SameSeedGivesTheSameDiscs) {
  DrapeTestOptions options = quick();
  options.seconds = 0.25;
  const DrapeResult one = measure_drape({.bending = 2e-5}, options);
  const DrapeResult again = measure_drape({.bending = 2e-5}, options);
  ASSERT_EQ(one.discs.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i)
    EXPECT_EQ(one.discs[i].coefficient, again.discs[i].coefficient);
  EXPECT_NE(one.discs[0].coefficient, one.discs[1].coefficient);
}

TEST(DrapeCoefficient, FitFindsTheStiffnessThatWasMeasured) {
  DrapeTestOptions options = quick();
  options.starts = 1;
  const Material material{.density = 0.2, .bending = 3e-5};
  const double measured = measure_drape(material, options).coefficient;
  const FittedBending fit = fit_bending({.density = 0.2}, measured, options);
  EXPECT_NEAR(fit.drape.coefficient, measured, 0.005);
  // So coarse a disc has other numbers of folds on either side, some of which drape alike.
  EXPECT_GT(fit.bending, 3e-5 / 2);
  EXPECT_LT(fit.bending, 3e-5 * 2);
}

TEST(DrapeCoefficient, OutOfReachNamesWhatIsInReach) {
  DrapeTestOptions options = quick();
  options.starts = 1;
  const std::string error = test::message_of<InputError>([&] { fit_bending({}, 0.999, options); });
  EXPECT_NE(error.find("drape: 99.9 %, which no bending stiffness of cloth gives at 0.2 kg/m^2; "
                       "one of "),
            std::string::npos)
      << error;
}

TEST(DrapeCoefficient, EvenSizesAreRefused) {
  DrapeTestOptions options = quick();
  options.size = 64;
  EXPECT_THROW(measure_drape({}, options), SceneError);
}

TEST(DrapeCoefficient, BendingLengthIsThatOfTheCantilever) {
  // 0.15 kg/m^2 and 2 cm: 11.8 uN m.
  EXPECT_NEAR(bending_of_length(0.15, 0.02), 1.1772e-5, 1e-12);
  EXPECT_NEAR(length_of_bending(0.15, 1.1772e-5), 0.02, 1e-12);
}

}  // namespace
}  // namespace weft

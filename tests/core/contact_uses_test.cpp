#include "weft/core/contact_uses.h"

#include <gtest/gtest.h>

namespace weft {
namespace {

TEST(ContactUses, AreFoundBySampleInTheOrderAdded) {
  ContactUses uses(100);
  for (int round = 0; round < 2; ++round) {
    uses.clear();
    uses.add(70, {0, 1.0F});
    uses.add(8, {0, -0.5F});
    uses.add(70, {1, 0.25F});
    uses.add(70, {2, 2.0F});
    uses.finish();
    ASSERT_EQ(uses.samples().size(), 2U);
    EXPECT_EQ(uses.samples()[0], 8);
    EXPECT_EQ(uses.samples()[1], 70);
    EXPECT_EQ(uses.index_of(8), 0);
    EXPECT_EQ(uses.index_of(70), 1);
    ASSERT_EQ(uses.of(0).size(), 1U);
    EXPECT_EQ(uses.of(0)[0].weight, -0.5F);
    ASSERT_EQ(uses.of(1).size(), 3U);
    for (int i = 0; i < 3; ++i) EXPECT_EQ(uses.of(1)[i].contact, i);
  }
  uses.clear();
  uses.finish();
  EXPECT_TRUE(uses.samples().empty());
}

}  // namespace
}  // namespace weft

#include "weft/table5.h"

#include <gtest/gtest.h>

namespace weft {
namespace {

TEST(Table5, HoldsTheRowsOfFigure5) {
  EXPECT_EQ(figure5().size(), 19U);
  int last = 0;
  for (const Figure5Row& row : figure5()) {
    EXPECT_EQ((row.n - 1) % (row.global_size - 1), 0) << row.n << ", " << row.global_size;
    EXPECT_EQ(row.local_size % 2, 1);
    EXPECT_EQ(row.n % 10, 1);
    EXPECT_GE(row.n, last);
    last = row.n;
  }
}

TEST(Table5, MultigridIsNearerToTheConvergedSolutionAtEverySize) {
  Table5Options options;
  options.rows = figure5().first(4);
  options.frames = 20;
  options.rounds = 1;
  options.errors = true;
  const std::vector<Table5Row> rows = measure_table5(options);
  ASSERT_EQ(rows.size(), 4U);
  for (const Table5Row& row : rows) {
    EXPECT_EQ(row.particles, row.paper.n * row.paper.n);
    for (const double seconds : {row.global_matrix, row.local_matrix, row.dense_matrix,
                                 row.two_level, row.desbrun, row.multigrid}) {
      EXPECT_GT(seconds, 0);
      EXPECT_LT(seconds, 1);
    }
    // All fall alike, by half a metre; they differ in how the waves go.
    EXPECT_LT(*row.two_level_error, 0.01);
    EXPECT_LT(*row.desbrun_error, 0.01);
    EXPECT_LT(*row.multigrid_error, 0.3 * *row.two_level_error);
  }
}

TEST(Table5, ErrorsAreForThoseWhoAsk) {
  Table5Options options;
  options.rows = figure5().first(1);
  options.frames = options.rounds = 1;
  const Table5Row row = measure_table5(options).front();
  EXPECT_FALSE(row.two_level_error || row.desbrun_error || row.multigrid_error);
}

struct StopAtOnce : Progress {
  void update(std::string_view, double) override { throw 1; }
};

TEST(Table5, StopsWhereItsProgressDoes) {
  StopAtOnce stop;
  Table5Options options;
  options.progress = &stop;
  EXPECT_THROW(measure_table5(options), int);
}

}  // namespace
}  // namespace weft

// What passes between the window's thread and the simulating one.
#include <array>
#include <thread>

#include <gtest/gtest.h>

#include "apps/viewer/command_queue.h"
#include "apps/viewer/simulator.h"

namespace weft::viewer {
namespace {

TEST(TripleBuffer, NothingIsNewUntilSomethingIsPublished) {
  TripleBuffer<int> buffer;
  EXPECT_FALSE(buffer.update());
  buffer.back() = 5;
  EXPECT_FALSE(buffer.update());
  buffer.publish();
  EXPECT_TRUE(buffer.update());
  EXPECT_EQ(buffer.front(), 5);
  EXPECT_FALSE(buffer.update());
  EXPECT_EQ(buffer.front(), 5);
}

TEST(TripleBuffer, TheNewestIsReadAndWhatIsReadStays) {
  TripleBuffer<int> buffer;
  for (int i = 1; i <= 4; ++i) {
    buffer.back() = i;
    buffer.publish();
  }
  ASSERT_TRUE(buffer.update());
  EXPECT_EQ(buffer.front(), 4);
  for (int i = 5; i <= 9; ++i) {
    buffer.back() = i;
    EXPECT_EQ(buffer.front(), 4);
    buffer.publish();
  }
  ASSERT_TRUE(buffer.update());
  EXPECT_EQ(buffer.front(), 9);
}

TEST(TripleBuffer, AcrossThreadsValuesAreWholeAndNeverOlder) {
  struct Block {
    std::array<int, 64> numbers{};
  };
  constexpr int last = 20000;
  TripleBuffer<Block> buffer;
  std::thread writer([&] {
    for (int i = 1; i <= last; ++i) {
      buffer.back().numbers.fill(i);
      buffer.publish();
    }
  });
  int before = 0;
  while (before < last) {
    if (!buffer.update()) {
      std::this_thread::yield();
      continue;
    }
    const Block& read = buffer.front();
    EXPECT_GT(read.numbers[0], before);
    before = read.numbers[0];
    for (const int number : read.numbers) ASSERT_EQ(number, before);
  }
  writer.join();
}

TEST(CommandQueue, CommandsComeInOrderAndOnce) {
  CommandQueue queue;
  queue.push(Play{true});
  queue.push(StepOnce{});
  queue.push(Open{"a"});
  std::vector<Command> taken;
  queue.take(taken);
  ASSERT_EQ(taken.size(), 3U);
  EXPECT_TRUE(std::holds_alternative<Play>(taken[0]));
  EXPECT_TRUE(std::holds_alternative<StepOnce>(taken[1]));
  EXPECT_EQ(std::get<Open>(taken[2]).subject, "a");
  queue.take(taken);
  EXPECT_TRUE(taken.empty());
}

TEST(CommandQueue, OfPullsInARowTheLastIsKept) {
  CommandQueue queue;
  queue.push(Grab{0, 3});
  for (int i = 0; i < 10; ++i) queue.push(Pull{{0, 1.0 * i, 0}});
  queue.push(LetGo{});
  queue.push(Pull{{7, 7, 7}});
  std::vector<Command> taken;
  queue.take(taken);
  ASSERT_EQ(taken.size(), 4U);
  EXPECT_EQ(std::get<Pull>(taken[1]).target.y, 9);
  EXPECT_EQ(std::get<Pull>(taken[3]).target.x, 7);
}

TEST(CommandQueue, StepsAreAllKept) {
  CommandQueue queue;
  for (int i = 0; i < 3; ++i) queue.push(StepOnce{});
  std::vector<Command> taken;
  queue.take(taken);
  EXPECT_EQ(taken.size(), 3U);
}

TEST(CommandQueue, WaitingEndsWithACommandOrWithStop) {
  using Clock = std::chrono::steady_clock;
  CommandQueue queue;
  EXPECT_FALSE(queue.wait_until(Clock::now()));
  std::thread other([&] { queue.push(StepOnce{}); });
  EXPECT_TRUE(queue.wait_until(Clock::now() + std::chrono::minutes(5)));
  other.join();
  std::vector<Command> taken;
  queue.take(taken);
  std::thread stopper([&] { queue.stop(); });
  EXPECT_FALSE(queue.wait_until(Clock::now() + std::chrono::minutes(5)));
  stopper.join();
  EXPECT_TRUE(queue.stopped());
}

TEST(CommandQueue, OnlyOpeningOvertakesWhatIsLoaded) {
  CommandQueue queue;
  queue.push(Play{false});
  queue.push(Reset{});
  EXPECT_FALSE(queue.is_overtaken());
  queue.push(Open{"other"});
  EXPECT_TRUE(queue.is_overtaken());
}

TEST(CommandQueue, NothingIsLostBetweenThreads) {
  CommandQueue queue;
  constexpr int count = 5000;
  std::thread pusher([&] {
    for (int i = 0; i < count; ++i) queue.push(Grab{0, i});
  });
  int next = 0;
  std::vector<Command> taken;
  while (next < count) {
    queue.wait_until(std::chrono::steady_clock::now() + std::chrono::seconds(1));
    queue.take(taken);
    for (const Command& command : taken) ASSERT_EQ(std::get<Grab>(command).sample, next++);
  }
  pusher.join();
}

}  // namespace
}  // namespace weft::viewer

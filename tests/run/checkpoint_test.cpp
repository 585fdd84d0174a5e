#include "weft/run/checkpoint.h"

#include <cstring>
#include <string>

#include <gtest/gtest.h>

#include "tests/support/errors.h"
#include "tests/support/temporary_folder.h"
#include "weft/core/hash.h"
#include "weft/core/random.h"
#include "weft/files.h"

namespace weft {
namespace {

/// Magic, format version, size and hash.
constexpr std::size_t header_bytes = 8 + 4 + 8 + 8, hash_at = 8 + 4 + 8;

ClothState numbered(int size, float first) {
  ClothState state{Planes3(size), Planes3(size)};
  for (int s = 0; s < size * size; ++s) {
    const auto value = first + static_cast<float>(s);
    state.position.set(s, {value, -value, 1 / value});
    state.velocity.set(s, {0, -0.0F, value / 3});
  }
  return state;
}

Checkpoint sample() {
  Checkpoint checkpoint;
  checkpoint.identity = R"({"substeps":4})";
  checkpoint.start_centre = {1, 2, 3};
  checkpoint.intersections = {2, {.self = 7, .cloths = 1LL << 40, .bodies = 9, .ground = 10}};
  checkpoint.verification = {{1, 5}, {2, 1LL << 40}, {3, 6}};
  for (int i = 1; i <= 3; ++i) {
    FrameReport frame;
    frame.milliseconds = 0.1 * i;
    frame.iterations = 10 * i;
    frame.whole_fell_back = i;
    frame.buried = 7 * i;
    frame.lost_time = 1e-3 * i;
    frame.strain = {0.01, 0.02, 0.03 * i};
    frame.centre_of_mass = {0, -0.1 * i, 1e-300};
    checkpoint.history.push_back(frame);
  }
  checkpoint.state = {3, {numbered(5, 1), numbered(6, 100)}};
  checkpoint.state.frames_unexplained = 1;
  checkpoint.state.fitted = {0, 1};
  checkpoint.state.contacts = {{}, {{{1, 2, -1, -1}, 1, {0, 1, 0}, {3, -4, 5}, 6, 7}}};
  for (const float offset : {0.25F, 0.5F}) {
    StruckContact struck;
    struck.shared.contact.offset = offset;
    struck.body = 2;
    struck.way = {1, 2, offset};
    checkpoint.state.struck.push_back(struck);
  }
  return checkpoint;
}

std::string refusal(const std::string& bytes) {
  return test::message_of<InputError>([&] { (void)decode_checkpoint(bytes, "there.bin"); });
}

/// What a writer that makes mistakes, or means ill, could leave: the hash fits.
std::string hashed_again(std::string bytes) {
  Hash hash;
  hash.add(std::span<const char>(bytes).subspan(header_bytes));
  const std::uint64_t value = hash.value();
  std::memcpy(bytes.data() + hash_at, &value, sizeof(value));
  return bytes;
}

TEST(Checkpoint, ReadsBackBitByBit) {
  const test::TemporaryFolder folder;
  const Checkpoint written = sample();
  write_checkpoint(folder / "c.bin", written);
  EXPECT_EQ(folder.entries(), 1);
  const auto read = read_checkpoint(folder / "c.bin");
  ASSERT_TRUE(read);
  EXPECT_EQ(read->identity, written.identity);
  EXPECT_EQ(read->state.frame, 3);
  EXPECT_EQ(read->intersections.frame, 2);
  EXPECT_EQ(read->intersections.counts.cloths, 1LL << 40);
  EXPECT_EQ(read->intersections.counts.ground, 10);
  EXPECT_EQ(read->history[1].strain.max, written.history[1].strain.max);
  EXPECT_EQ(read->history[2].smallest_gap, HUGE_VAL);
  EXPECT_EQ(read->history[2].whole_fell_back, 3);
  EXPECT_EQ(read->history[2].buried, 7 * 3);
  EXPECT_EQ(read->history[2].lost_time, 1e-3 * 3);
  EXPECT_EQ(read->state.frames_unexplained, 1);
  EXPECT_EQ(read->state.fitted, (std::vector<char>{0, 1}));
  EXPECT_EQ(read->verification.swallowed.frame, 2);
  EXPECT_EQ(read->verification.swallowed.count, 1LL << 40);
  ASSERT_EQ(read->state.cloths.size(), 2);
  EXPECT_TRUE(std::signbit(read->state.cloths[0].velocity.y(0, 0)));
  ASSERT_EQ(read->state.contacts[1].size(), 1);
  EXPECT_EQ(read->state.contacts[1][0].friction, (Vec3f{3, -4, 5}));
  EXPECT_EQ(read->state.contacts[1][0].acceleration, 7);
  ASSERT_EQ(read->state.struck.size(), 2);
  EXPECT_EQ(read->state.struck[1].shared.contact.offset, 0.5F);
  EXPECT_EQ(read->state.struck[1].body, 2);
  EXPECT_EQ(read->state.struck[1].way, (Vec3f{1, 2, 0.5F}));
  // Every bit of every field.
  EXPECT_EQ(encode_checkpoint(*read), encode_checkpoint(written));
}

TEST(Checkpoint, NoFileIsNoCheckpoint) {
  const test::TemporaryFolder folder;
  EXPECT_FALSE(read_checkpoint(folder / "c.bin"));
  EXPECT_THROW((void)read_checkpoint(folder.path()), InputError);
}

TEST(Checkpoint, AnyChangedByteIsRefusedByTheFilesName) {
  const std::string whole = encode_checkpoint(sample());
  for (std::size_t at = 0; at < whole.size(); ++at)
    for (const char flip : {'\x01', '\x80', '\xff'}) {
      std::string damaged = whole;
      damaged[at] = static_cast<char>(damaged[at] ^ flip);
      ASSERT_NE(refusal(damaged).find("there.bin: "), std::string::npos) << at;
    }
}

TEST(Checkpoint, AnyOtherLengthIsRefused) {
  const std::string whole = encode_checkpoint(sample());
  for (std::size_t size = 0; size < whole.size(); ++size)
    ASSERT_FALSE(refusal(whole.substr(0, size)).empty()) << size;
  EXPECT_NE(refusal(whole + '\0').find("is damaged"), std::string::npos);
}

TEST(Checkpoint, RefusalsSayWhatIsWrong) {
  const std::string whole = encode_checkpoint(sample());
  EXPECT_NE(refusal("").find("is no checkpoint"), std::string::npos);
  std::string other_format = whole;
  other_format[8] = 15;
  EXPECT_NE(refusal(other_format).find("format 15 instead of 14"), std::string::npos);
  std::string other_version = whole;
  other_version[header_bytes + 8] = '7';
  EXPECT_NE(refusal(hashed_again(other_version)).find("written by weft 7"), std::string::npos);
  EXPECT_NE(refusal(whole.substr(0, 100)).find("100 bytes instead of"), std::string::npos);
}

TEST(Checkpoint, ContactsOfSamplesThatNoClothHasAreRefused) {
  const auto refused = [](int index, int second) {
    Checkpoint checkpoint = sample();
    checkpoint.state.contacts = {{{{0, index, -1, -1}, second, {0, 1, 0}, {}, 6, 7}}, {}};
    return !refusal(encode_checkpoint(checkpoint)).empty();
  };
  EXPECT_FALSE(refused(24, -1));
  EXPECT_TRUE(refused(25, -1)) << "of a cloth of 5 x 5";
  EXPECT_FALSE(refused(35, 1));
  EXPECT_TRUE(refused(36, 1)) << "the other has 6 x 6";
  EXPECT_TRUE(refused(-2, -1));
}

TEST(Checkpoint, ChangesWithAFittingHashAreReadOrRefused) {
  const std::string whole = encode_checkpoint(sample());
  Random random(5);
  int refused = 0;
  for (int round = 0; round < 3000; ++round) {
    std::string changed = whole;
    for (int i = 0; i < 3; ++i) {
      const auto at = header_bytes + random.next() % (changed.size() - header_bytes);
      changed[at] = static_cast<char>(random.next());
    }
    // Lengths and counts stand among the first fields: strike those as often as all others.
    changed[header_bytes + random.next() % 100] = static_cast<char>(random.next());
    refused += refusal(hashed_again(changed)).empty() ? 0 : 1;
  }
  EXPECT_GT(refused, 800);
  EXPECT_LT(refused, 3000);
}

}  // namespace
}  // namespace weft

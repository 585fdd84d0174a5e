#include "weft/point_cache.h"

#include <bit>
#include <fstream>
#include <limits>
#include <string>

#include <gtest/gtest.h>

#include "tests/support/errors.h"
#include "tests/support/temporary_folder.h"
#include "weft/error.h"

namespace weft {
namespace {

std::string word(std::uint32_t value, bool big_endian) {
  std::string bytes(4, '\0');
  for (int i = 0; i < 4; ++i) bytes[big_endian ? 3 - i : i] = static_cast<char>(value >> (8 * i));
  return bytes;
}

std::string word(float value, bool big_endian) {
  return word(std::bit_cast<std::uint32_t>(value), big_endian);
}

std::string numbers(std::initializer_list<float> values, bool big_endian) {
  std::string bytes;
  for (const float value : values) bytes += word(value, big_endian);
  return bytes;
}

/// Of so many points and samples as its header says, whatever follows.
std::string pc2(std::uint32_t points, float step, std::uint32_t samples, const std::string& body) {
  return std::string("POINTCACHE2\0", 12) + word(1U, false) + word(points, false) +
         word(5.0F, false) + word(step, false) + word(samples, false) + body;
}

const std::string two_points =
    pc2(2, 0.5F, 2, numbers({1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12}, false));
const std::string one_point =
    word(3U, true) + word(1U, true) + numbers({2, 2.5, 4, 1, 2, 3, 4, 5, 6, 7, 8, 9}, true);

std::string error_of(PointCache (*parse)(std::string_view, std::string_view),
                     const std::string& bytes) {
  return test::message_of<InputError>([&] { parse(bytes, "a"); });
}

TEST(PointCache, Pc2HoldsSamplesAndCountsFrames) {
  const PointCache cache = parse_pc2(two_points, "a");
  EXPECT_EQ(cache.points, 2);
  EXPECT_TRUE(cache.times_in_frames);
  EXPECT_EQ(cache.times, (std::vector<double>{0, 0.5}));
  EXPECT_EQ(cache.sample(0)[1], (Vec3f{4, 5, 6}));
  EXPECT_EQ(cache.sample(1)[0], (Vec3f{7, 8, 9}));
}

TEST(PointCache, MddHoldsSamplesAtTimesFromItsFirst) {
  const PointCache cache = parse_mdd(one_point, "a");
  EXPECT_EQ(cache.points, 1);
  EXPECT_FALSE(cache.times_in_frames);
  EXPECT_EQ(cache.times, (std::vector<double>{0, 0.5, 2}));
  EXPECT_EQ(cache.sample(2)[0], (Vec3f{7, 8, 9}));
}

TEST(PointCache, EveryCutAndEverySpareByteIsRefused) {
  for (const auto& [parse, bytes] :
       {std::pair{&parse_pc2, two_points}, std::pair{&parse_mdd, one_point}}) {
    for (std::size_t size = 0; size < bytes.size(); ++size)
      EXPECT_FALSE(error_of(parse, bytes.substr(0, size)).empty()) << size;
    EXPECT_FALSE(error_of(parse, bytes + 'x').empty());
  }
}

TEST(PointCache, ErrorsSayWhatIsTheMatter) {
  EXPECT_EQ(error_of(parse_pc2, two_points + 'x'),
            "a: is 81 bytes long with 2 points and 2 samples; a whole point cache is wanted");
  EXPECT_EQ(error_of(parse_pc2, "POINTCLOUD"),
            "a: does not begin as a PC2 file does; a point cache is wanted");
  EXPECT_EQ(error_of(parse_pc2, pc2(1, 1, 0, "")),
            "a: 1 points and 0 samples; at least one of each is wanted");
  EXPECT_EQ(error_of(parse_pc2, pc2(1, -1, 1, numbers({0, 0, 0}, false))),
            "a: -1 frames between two samples; a number > 0 is wanted");
  const float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(error_of(parse_pc2, pc2(1, 1, 2, numbers({0, 0, 0, 0, nan, 0}, false))),
            "a: a coordinate of point 0 in sample 1 is not finite; finite numbers are wanted");
  EXPECT_EQ(error_of(parse_mdd,
                     word(2U, true) + word(1U, true) + numbers({1, 1, 0, 0, 0, 0, 0, 0}, true)),
            "a: the time of sample 1 does not follow; ascending times are wanted");
}

TEST(PointCache, CountsThatNoFileCouldHoldAllocateNothing) {
  const std::string body = numbers({0, 0, 0}, false);
  EXPECT_FALSE(error_of(parse_pc2, pc2(0x7fffffff, 1, 0x7fffffff, body)).empty());
  EXPECT_FALSE(error_of(parse_pc2, pc2(0x80000000, 1, 2, body)).empty());
  EXPECT_FALSE(
      error_of(parse_mdd, word(0xffffffffU, true) + word(0xffffffffU, true) + body).empty());
}

TEST(PointCache, FilesAreReadByTheirEnding) {
  const test::TemporaryFolder folder;
  const auto write = [&](const char* name, const std::string& bytes) {
    std::ofstream(folder / name, std::ios::binary) << bytes;
    return folder / name;
  };
  EXPECT_EQ(read_point_cache(write("a.PC2", two_points)).points, 2);
  EXPECT_EQ(read_point_cache(write("a.mdd", one_point)).points, 1);
  EXPECT_THROW(read_point_cache(write("a.abc", two_points)), InputError);
  EXPECT_THROW(read_point_cache(folder / "none.pc2"), InputError);
}

}  // namespace
}  // namespace weft

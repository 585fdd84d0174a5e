#include <bit>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/mesh/npz_files.h"
#include "tests/support/errors.h"
#include "tests/support/temporary_folder.h"
#include "weft/files.h"
#include "weft/point_cache.h"

namespace weft {
namespace {

using test::little_endian, test::npy, test::zip;

std::string floats(const std::vector<float>& values) {
  std::string bytes;
  for (const float value : values) bytes += little_endian(std::bit_cast<std::uint32_t>(value), 4);
  return bytes;
}

std::string doubles(const std::vector<double>& values, bool big_endian = false) {
  std::string bytes;
  for (const double value : values) {
    std::string number = little_endian(std::bit_cast<std::uint64_t>(value), 8);
    if (big_endian) number.assign(number.rbegin(), number.rend());
    bytes += number;
  }
  return bytes;
}

/// Two samples of two points: 1 to 12.
const std::string two_by_two =
    npy("<f4", "(2, 2, 3)", floats({1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12}));

std::string with_vertices(const std::string& array, const test::ZipOptions& options = {}) {
  return zip({{"vertices.npy", array}}, options);
}

std::string error_of(const std::string& bytes) {
  return test::message_of<InputError>([&] { parse_npz(bytes, "a"); });
}

void expect_counted(const std::string& bytes) {
  const PointCache cache = parse_npz(bytes, "a");
  EXPECT_EQ(cache.points, 2);
  ASSERT_EQ(cache.samples(), 2);
  EXPECT_EQ(cache.sample(0)[1], (Vec3f{4, 5, 6}));
  EXPECT_EQ(cache.sample(1)[0], (Vec3f{7, 8, 9}));
  EXPECT_EQ(cache.sample(1)[1], (Vec3f{10, 11, 12}));
}

TEST(Npz, StoredDeflatedAndWideArchivesHoldTheSame) {
  for (const bool deflate : {false, true})
    for (const bool wide : {false, true}) {
      test::ZipOptions options;
      options.deflate = deflate;
      options.wide = wide;
      expect_counted(with_vertices(two_by_two, options));
    }
}

TEST(Npz, DoublesBigEndianAndFortranOrderAreTheSameNumbers) {
  const std::vector<double> numbers{1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12};
  const std::vector<double> first_fastest{1, 7, 4, 10, 2, 8, 5, 11, 3, 9, 6, 12};
  expect_counted(with_vertices(npy("<f8", "(2, 2, 3)", doubles(numbers))));
  expect_counted(with_vertices(npy(">f8", "(2, 2, 3)", doubles(numbers, true))));
  expect_counted(with_vertices(npy("<f8", "(2, 2, 3)", doubles(first_fastest), true)));
}

TEST(Npz, FramesAreTheScenesUnlessARateIsThere) {
  const PointCache plain = parse_npz(with_vertices(two_by_two), "a");
  EXPECT_TRUE(plain.times_in_frames);
  EXPECT_EQ(plain.times, (std::vector<double>{0, 1}));
  for (const auto& [key, array] :
       {std::pair{"fps.npy", npy("<i4", "()", little_endian(25, 4))},
        std::pair{"frame_rate.npy", npy("<f8", "(1,)", doubles({25}))}}) {
    const PointCache rated = parse_npz(zip({{"vertices.npy", two_by_two}, {key, array}}), "a");
    EXPECT_FALSE(rated.times_in_frames);
    EXPECT_EQ(rated.times, (std::vector<double>{0, 0.04}));
  }
  EXPECT_EQ(error_of(zip({{"vertices.npy", two_by_two},
                          {"fps.npy", npy("<i2", "()", little_endian(0xffff, 2))}})),
            "a: fps is no frame rate; one number from 1e-6 to 1e6 is wanted");
}

TEST(Npz, EveryCutAndEverySpareByteIsRefused) {
  test::ZipOptions options;
  options.deflate = true;
  for (const std::string& whole : {with_vertices(two_by_two), with_vertices(two_by_two, options)})
    for (std::size_t length = 0; length < whole.size(); ++length)
      EXPECT_NE(error_of(whole.substr(0, length)), "") << length;
  EXPECT_NE(error_of(with_vertices(two_by_two + "x")), "");
  EXPECT_NE(error_of(with_vertices(two_by_two.substr(0, two_by_two.size() - 1))), "");
}

TEST(Npz, PythonObjectsAreNeverLoaded) {
  EXPECT_EQ(error_of(with_vertices(npy("|O", "(2, 2, 3)", "cos\nsystem\n"))),
            "a: vertices: holds Python objects, which are never loaded; an array of numbers is "
            "wanted");
}

TEST(Npz, OtherTypesAndShapesAreNamed) {
  const auto error = [](const std::string& type, const std::string& shape, std::size_t bytes) {
    return error_of(with_vertices(npy(type, shape, std::string(bytes, '\0'))));
  };
  EXPECT_EQ(error("<f2", "(1, 1, 3)", 6),
            "a: vertices: holds numbers of the type '<f2'; float32 or float64 is wanted");
  EXPECT_EQ(error("<c8", "(1, 1, 3)", 24),
            "a: vertices: holds numbers of the type '<c8'; float32 or float64 is wanted");
  EXPECT_EQ(error("<i8", "(1, 1, 3)", 24),
            "a: vertices holds whole numbers; float32 or float64 is wanted");
  EXPECT_EQ(error("<f4", "(2, 3)", 24),
            "a: vertices has the shape (2, 3); (frames, vertices, 3) is wanted");
  EXPECT_EQ(error("<f4", "(1, 3, 2)", 24),
            "a: vertices has the shape (1, 3, 2); (frames, vertices, 3) is wanted");
  EXPECT_EQ(error("<f4", "(0, 3, 3)", 0),
            "a: vertices has the shape (0, 3, 3); (frames, vertices, 3) is wanted");
  EXPECT_EQ(
      error("<f4", "(9999999999, 9999999999, 3)", 24),
      "a: vertices: has 24 bytes of 4 each for the shape (9999999999, 9999999999, 3); a whole "
      "array is wanted");
}

TEST(Npz, NumbersThatAreNotFiniteAreNamed) {
  const double none = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(error_of(with_vertices(npy("<f8", "(1, 2, 3)", doubles({1, 2, 3, 4, none, 6})))),
            "a: a coordinate of point 1 in sample 0 is not finite; finite numbers are wanted");
  EXPECT_EQ(
      error_of(with_vertices(npy("<f8", "(1, 1, 3)", doubles({1, 2, 1e31})))),
      "a: a coordinate of point 0 in sample 0 is larger than 1e30; finite numbers are wanted");
}

TEST(Npz, TheArrayThatIsMissingIsNamedWithThoseThere) {
  EXPECT_EQ(
      error_of(zip({{"verts.npy", two_by_two}, {"faces.npy", two_by_two}})),
      "a: holds 'verts.npy', 'faces.npy'; an array 'vertices' of the shape (frames, vertices, "
      "3) is wanted");
  EXPECT_EQ(error_of(zip({})),
            "a: holds nothing; an array 'vertices' of the shape (frames, vertices, 3) is wanted");
  EXPECT_EQ(error_of("OFF 1 2 3"),
            "a: does not begin as a zip archive does; a whole zip archive is wanted");
}

TEST(Npz, ArchivesThatTellOtherSizesAllocateNothing) {
  test::ZipOptions options;
  options.told_size = std::uint64_t{1} << 60U;
  options.wide = true;
  for (const bool deflate : {false, true}) {
    options.deflate = deflate;
    EXPECT_NE(error_of(with_vertices(two_by_two, options)).find("tells 1152921504606846976 bytes"),
              std::string::npos);
  }
  options.told_size = two_by_two.size() - 1;
  EXPECT_EQ(error_of(with_vertices(two_by_two, options)),
            "a: 'vertices.npy' cannot be unpacked; a whole zip archive is wanted");
}

TEST(Npz, DamagedEncryptedAndForeignMembersAreRefused) {
  std::string damaged = with_vertices(two_by_two);
  damaged[damaged.find("\x93NUMPY") + two_by_two.size() - 1] ^= 1;
  EXPECT_EQ(error_of(damaged),
            "a: 'vertices.npy' has another checksum; a whole zip archive is wanted");
  test::ZipOptions options;
  options.flags = 1;
  EXPECT_EQ(error_of(with_vertices(two_by_two, options)),
            "a: 'vertices.npy' is encrypted; plain data are wanted");
  options.flags = 0;
  options.method = 14;
  EXPECT_EQ(error_of(with_vertices(two_by_two, options)),
            "a: 'vertices.npy' is compressed by method 14; deflate, or no compression, is wanted");
}

TEST(Npz, HeadersThatNumpyDoesNotWriteAreRefused) {
  const auto error = [](const std::string& header) {
    return error_of(with_vertices(std::string("\x93NUMPY\x01\0", 8) +
                                  little_endian(header.size(), 2) + header));
  };
  EXPECT_EQ(error("{'descr': '<f4', 'shape': (1, 1, 3)}"),
            "a: vertices: has 2 keys of 3 in its header; a header as numpy writes it is wanted");
  EXPECT_EQ(error("{'descr': '<f4', 'fortran_order': None, 'shape': (1, 1, 3)}"),
            "a: vertices: has neither True nor False in its header; a header as numpy writes it is "
            "wanted");
  EXPECT_EQ(error("{'descr': [('x', '<f4')], 'fortran_order': False, 'shape': (1,)}"),
            "a: vertices: holds records of several fields; numbers are wanted");
  EXPECT_EQ(error("{'descr': '<f4', 'descr': '<f8', 'fortran_order': False, 'shape': (1, 1, 3)}"),
            "a: vertices: has the key 'descr' twice in its header; a header as numpy writes it is "
            "wanted");
  for (const char* header :
       {"", "{", "{'descr", "{'descr': '<f4'", "{'shape': (1, -1, 3)}", "{1: 2}"})
    EXPECT_NE(error(header), "") << header;
}

TEST(Npz, FilesAreReadAndMeasuredByTheirName) {
  const test::TemporaryFolder folder;
  test::ZipOptions options;
  options.deflate = true;
  const std::string bytes = with_vertices(two_by_two, options);
  write_file(folder / "a.npz", [&](std::ostream& out) { out << bytes; });
  EXPECT_EQ(read_point_cache(folder / "a.npz").points, 2);
  EXPECT_EQ(point_cache_bytes(folder / "a.npz", {}), two_by_two.size());
}

}  // namespace
}  // namespace weft

#include "weft/image/io/plane_codec.h"

#include <algorithm>
#include <bit>
#include <cstdlib>
#include <optional>
#include <utility>

#include "weft/error.h"
#include "weft/image/io/range_coder.h"

namespace weft {
namespace {

constexpr int axes = 3, passes = 4, magnitudes = 32, lengths = 18;
constexpr int largest_whole = 65535;
/// The coarsest level has about so many samples a side.
constexpr int coarsest_side = 5;

struct Offset {
  int row = 0, col = 0;
};

/// Where the neighbours lie, in steps of a level, whose differences tell how large the next may be:
/// of each pass those that came before it.
constexpr std::array<std::array<Offset, 4>, passes> known_before{{
    {{{0, -1}, {-1, 0}, {-1, -1}, {-1, 1}}},  // the coarsest level
    {{{0, -2}, {-2, 0}, {-2, -2}, {-2, 2}}},  // between two of a row
    {{{-1, -1}, {-1, 1}, {1, -1}, {1, 1}}},   // between two of a column
    {{{0, -1}, {0, 1}, {-1, 0}, {1, 0}}},     // in the middle of four
}};

/// The half of a power of two that a sum lies in.
int magnitude_of(unsigned sum) {
  const int bits = std::bit_width(sum);
  const int half = bits < 2 ? 0 : static_cast<int>(sum >> static_cast<unsigned>(bits - 2) & 1U);
  return std::min(2 * bits + half, magnitudes - 1);
}

struct DifferenceModels {
  struct OfMagnitude {
    std::array<AdaptiveBit, lengths> longer;
    std::array<std::array<AdaptiveBit, 6>, lengths> leading;  ///< the two bits below the first
  };
  std::array<std::array<std::array<OfMagnitude, magnitudes>, passes>, 2> models;
  std::array<AdaptiveBit, 3> sign;

  OfMagnitude& of(bool last_axis, int pass, int magnitude) {
    return models[last_axis ? 1 : 0][static_cast<std::size_t>(pass)]
                 [static_cast<std::size_t>(magnitude)];
  }
};

class Writing {
 public:
  bool bit(AdaptiveBit& model, bool value) {
    coder_.encode(model, value);
    return value;
  }
  bool even(bool value) {
    coder_.encode_even(value);
    return value;
  }
  std::string finish() { return coder_.finish(); }

 private:
  RangeEncoder coder_;
};

class Reading {
 public:
  explicit Reading(std::string_view bytes) : coder_(bytes) {}
  bool bit(AdaptiveBit& model, bool) { return coder_.decode(model); }
  bool even(bool) { return coder_.decode_even(); }
  [[nodiscard]] bool is_short() const { return coder_.is_short(); }

 private:
  RangeDecoder coder_;
};

/// A difference by the length of its size in bits, that size, and its sign. An encoder is given it,
/// a decoder finds it.
template <class Coder>
int code(Coder& coder, DifferenceModels::OfMagnitude& models, AdaptiveBit& sign, int value) {
  const auto size = static_cast<unsigned>(std::abs(value));
  const int told = std::bit_width(size);
  int length = 0;
  while (length < lengths - 1 &&
         coder.bit(models.longer[static_cast<std::size_t>(length)], length < told))
    ++length;
  if (length == 0) return 0;
  unsigned found = 1;
  for (int k = length - 2; k >= 0; --k) {
    const bool wanted = (size >> static_cast<unsigned>(k) & 1U) != 0;
    const bool modelled = found < 4;
    found = found << 1U |
            (modelled ? coder.bit(models.leading[static_cast<std::size_t>(length)][found], wanted)
                      : coder.even(wanted));
  }
  const bool negative = coder.bit(sign, value < 0);
  return negative ? -static_cast<int>(found) : static_cast<int>(found);
}

/// Walks the samples of an image, coarse levels first, and codes their differences.
template <class Coder>
class PlaneWalk {
 public:
  PlaneWalk(const BorderMates& mates, WholePlanes& planes, Coder& coder)
      : mates_(mates), n_(mates.size()), planes_(planes), coder_(coder) {
    const auto samples = static_cast<std::size_t>(n_) * static_cast<std::size_t>(n_);
    known_.assign(samples, false);
    class_of_.assign(samples, -1);
    for (int k = 0; k < mates.class_count(); ++k)
      for (const int s : mates.copies(k)) class_of_[static_cast<std::size_t>(s)] = k;
    for (std::vector<int>& plane : differences_) plane.assign(samples, 0);
  }

  /// @return whether all numbers were in their range
  bool run() {
    int step = 1;
    while ((n_ - 1) / (2 * step) >= coarsest_side - 1) step *= 2;
    visit(step, {0, 0}, step, 0);
    for (int h = step / 2; h >= 1; h /= 2) {
      visit(h, {0, h}, 2 * h, 1);
      visit(h, {h, 0}, 2 * h, 2);
      visit(h, {h, h}, 2 * h, 3);
    }
    return sound_;
  }

 private:
  void visit(int h, Offset first, int stride, int pass) {
    for (int row = first.row; row < n_; row += stride)
      for (int col = first.col; col < n_; col += stride) {
        const int s = row * n_ + col;
        if (!known_[static_cast<std::size_t>(s)] && !mates_.is_hole(s))
          code_sample(row, col, h, pass);
      }
  }

  void code_sample(int row, int col, int h, int pass) {
    const auto s = static_cast<std::size_t>(row) * static_cast<std::size_t>(n_) +
                   static_cast<std::size_t>(col);
    const std::array<int, axes> guess = prediction(row, col, h, pass);
    int before = 0;  // sizes of the sample's differences so far
    for (std::size_t k = 0; k < axes; ++k) {
      const auto [magnitude, direction] = expected(row, col, h, pass, k, before);
      const int difference =
          code(coder_, models_.of(k == axes - 1, pass, magnitude),
               models_.sign[static_cast<std::size_t>(direction)], planes_[k][s] - guess[k]);
      differences_[k][s] = difference;
      planes_[k][s] = std::clamp(guess[k] + difference, 0, largest_whole);
      sound_ = sound_ && planes_[k][s] == guess[k] + difference;
      before += std::abs(difference);
    }
    spread(s);
  }

  /// Gives a sample's numbers to all of its class.
  void spread(std::size_t s) {
    known_[s] = true;
    if (class_of_[s] < 0) return;
    for (const int other : mates_.copies(class_of_[s])) {
      const auto to = static_cast<std::size_t>(other);
      known_[to] = true;
      for (std::size_t k = 0; k < axes; ++k) {
        planes_[k][to] = planes_[k][s];
        differences_[k][to] = differences_[k][s];
      }
    }
  }

  [[nodiscard]] std::optional<std::size_t> known_at(int from, int row, int col) const {
    if (row < 0 || col < 0 || row >= n_ || col >= n_) return std::nullopt;
    const int s = row * n_ + col;
    if (!known_[static_cast<std::size_t>(s)] || !mates_.same_chart(from, s)) return std::nullopt;
    return static_cast<std::size_t>(s);
  }

  struct Expected {
    int magnitude = 0, direction = 0;
  };
  [[nodiscard]] Expected expected(int row, int col, int h, int pass, std::size_t axis,
                                  int before) const {
    int sum = 0, signs = 0;
    for (const Offset& offset : known_before[static_cast<std::size_t>(pass)]) {
      const auto at = known_at(row * n_ + col, row + h * offset.row, col + h * offset.col);
      if (!at) continue;
      const int difference = differences_[axis][*at];
      sum += 4 * std::abs(difference);
      for (std::size_t k = 0; k < axes; ++k) sum += std::abs(differences_[k][*at]);
      signs += difference > 0 ? 1 : difference < 0 ? -1 : 0;
    }
    sum += (axis == 0 ? 0 : axis == 1 ? 4 : 2) * before;
    return {magnitude_of(static_cast<unsigned>(sum)), signs > 0 ? 2 : signs < 0 ? 1 : 0};
  }

  /// The guess along a line, and how much it is worth: 2 between neighbours, 1 beyond them.
  struct Guess {
    std::array<int, axes> value{};
    int worth = 0;
  };
  [[nodiscard]] Guess along(int row, int col, Offset step) const {
    const auto at = [&](int k) {
      return known_at(row * n_ + col, row + k * step.row, col + k * step.col);
    };
    const auto a = at(-1), b = at(1);
    if (!a && !b) return {};
    const auto before = at(-3), after = at(3);
    Guess guess{{}, a && b ? 2 : 1};
    for (std::size_t k = 0; k < axes; ++k) {
      const std::vector<int>& plane = planes_[k];
      if (a && b && before && after) {
        guess.value[k] = (9 * (plane[*a] + plane[*b]) - plane[*before] - plane[*after] + 8) >> 4;
      } else if (a && b) {
        guess.value[k] = (plane[*a] + plane[*b] + 1) >> 1;
      } else {
        const std::size_t near = a ? *a : *b;
        const auto far = a ? before : after;
        guess.value[k] = far ? plane[near] + (plane[near] - plane[*far]) / 2 : plane[near];
      }
    }
    return guess;
  }

  [[nodiscard]] std::array<int, axes> prediction(int row, int col, int h, int pass) const {
    Guess rows, cols;
    if (pass != 2) rows = along(row, col, {0, h});
    if (pass != 1) cols = along(row, col, {h, 0});
    if (rows.worth == 0 && pass == 2) rows = along(row, col, {0, h});
    if (cols.worth == 0 && pass == 1) cols = along(row, col, {h, 0});
    if (rows.worth == cols.worth && rows.worth > 0) {
      for (std::size_t k = 0; k < axes; ++k)
        rows.value[k] = (rows.value[k] + cols.value[k] + 1) >> 1;
      return rows.value;
    }
    return rows.worth > cols.worth ? rows.value : cols.value;
  }

  const BorderMates& mates_;
  int n_;
  WholePlanes& planes_;
  Coder& coder_;
  DifferenceModels models_;
  std::vector<bool> known_;
  std::vector<int> class_of_;
  WholePlanes differences_;
  bool sound_ = true;
};

}  // namespace

std::string encode_planes(const WholePlanes& planes, const BorderMates& mates) {
  WholePlanes copy = planes;
  Writing coder;
  PlaneWalk(mates, copy, coder).run();
  std::string bytes = coder.finish();
  // Zeros follow where holes, flat charts and mates leave less than readers ask for.
  bytes.resize(std::max(bytes.size(), min_bytes(planes[0].size())), '\0');
  return bytes;
}

WholePlanes decode_planes(std::string_view bytes, const BorderMates& mates, int most,
                          std::string_view where) {
  const auto samples = static_cast<std::size_t>(mates.size()) * mates.size();
  WholePlanes planes;
  for (std::vector<int>& plane : planes) plane.assign(samples, 0);
  Reading coder(bytes);
  bool sound = PlaneWalk(mates, planes, coder).run();
  if (coder.is_short())
    throw InputError(where, "ends in its samples", "a whole geometry image is wanted");
  for (const std::vector<int>& plane : planes)
    sound = sound && *std::max_element(plane.begin(), plane.end()) <= most;
  if (!sound) throw InputError(where, "samples out of their range", "a geometry image is wanted");
  return planes;
}

std::size_t min_bytes(std::size_t samples) { return samples * axes / (44 * 8); }

}  // namespace weft

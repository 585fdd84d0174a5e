#pragma once

#include <string>
#include <string_view>

namespace weft {

/// Told how far long work has come. An implementation throws Interrupted from `update` when its
/// user asked to stop: work that calls it must be safe to unwind there.
class Progress {
 public:
  Progress() = default;
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  virtual ~Progress() = default;
  /// @param stage     what is being done, a few words
  /// @param fraction  of that stage, in [0, 1]
  virtual void update(std::string_view stage, double fraction) = 0;
};

/// For callers that do not watch.
inline void update(Progress* progress, std::string_view stage, double fraction) {
  if (progress != nullptr) progress->update(stage, fraction);
}

/// A part of a stage that reports as if it were whole: its fractions fall between two of the whole
/// stage's, whose name is shown.
class PartOfProgress : public Progress {
 public:
  /// @param whole  may be null
  PartOfProgress(Progress* whole, std::string_view stage, double from, double to)
      : whole_(whole), stage_(stage), from_(from), to_(to) {}
  void update(std::string_view /*part*/, double fraction) override {
    weft::update(whole_, stage_, from_ + fraction * (to_ - from_));
  }

 private:
  Progress* whole_;
  std::string stage_;
  double from_, to_;
};

}  // namespace weft

#pragma once

#include <string>
#include <string_view>

namespace weft {

/// Receives the progress of long work. An implementation throws Interrupted from `update` when its
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

/// Reports progress; no-op for null.
inline void update(Progress* progress, std::string_view stage, double fraction) {
  if (progress != nullptr) progress->update(stage, fraction);
}

/// Progress of a part of a stage: maps the part's fractions to a range of the whole stage's, under
/// the stage's name.
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

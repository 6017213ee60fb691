// Signal temporal logic over sampled signals: what must hold of them, and when.
//
// Maler and Nickovic, Monitoring temporal properties of continuous signals, FORMATS 2004.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace towbench::harness {

// A number that each sample gives.
struct Expression {
  enum class Kind : std::uint8_t { kNumber, kSignal, kSum, kDifference, kScaled, kMagnitude };
  Kind kind = Kind::kNumber;
  double number = 0;       // of kNumber; the factor of kScaled
  std::size_t signal = 0;  // index in the vocabulary
  std::vector<Expression> parts{};
};

enum class Comparison : std::uint8_t { kLess, kAtMost, kMore, kAtLeast, kEqual };

// Relative to the sample at which a formula is read; both ends belong to it.
struct TimeBounds {
  double from_s = 0;
  double to_s = std::numeric_limits<double>::infinity();
};

struct Formula {
  enum class Kind : std::uint8_t {
    kCompare,
    kEvent,  // holds at the first sample at or after an event
    kNot,
    kAnd,
    kOr,
    kImplies,
    kAlways,      // in `window` when it has a name, else within `bounds`
    kEventually,  // the same
    kUntil,       // the second part within `bounds`, the first at every sample before
    kAfter,       // behind each event `event`, from bounds.to_s after it until the next `until`
  };
  Kind kind = Kind::kCompare;
  Comparison comparison = Comparison::kLess;
  std::vector<Expression> sides{};  // of kCompare: left, right
  double scale = 1;                 // of kCompare: a distance counts in units of it
  std::string event{};
  std::string until{};  // an event; empty: the end of the record
  std::string window{};
  TimeBounds bounds{};
  std::vector<Formula> parts{};
};

}  // namespace towbench::harness

// What this host has of what a bench on wires and in real time wants, one finding a line.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace towbench::harness {

// kGood: fit for all that the subject is about. kLimited: works, with the limit that is told.
// kMissing: that part of the bench does not work here.
enum class Fitness : std::uint8_t { kGood, kLimited, kMissing };

[[nodiscard]] constexpr std::string_view name_of(Fitness fit) noexcept {
  switch (fit) {
    case Fitness::kGood:
      return "good";
    case Fitness::kLimited:
      return "limited";
    case Fitness::kMissing:
      break;
  }
  return "missing";
}

struct Finding {
  std::string subject;
  Fitness fit = Fitness::kMissing;
  std::string found;   // what is there, and what it is fit for
  std::string remedy;  // empty when there is nothing to do
};

// Kernel, preemption, scheduler rights, timer, processors, CAN, GPIO, serial ports. Reads only;
// `root` stands before /proc, /sys and /dev, for tests.
[[nodiscard]] std::vector<Finding> host_findings(const std::filesystem::path& root = "/");

}  // namespace towbench::harness

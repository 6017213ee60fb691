// One search over several spaces of faults in turn, round by round, kept in a file as it goes: what
// was interrupted is continued, with the same trials.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "harness/falsify/box_search.h"
#include "harness/falsify/fault_space.h"
#include "harness/falsify/objective.h"

namespace towbench::harness {

struct FalsifyTrial {
  std::size_t space = 0;
  BoxPoint point{};
  bool uniform = false;
  SearchCase tried{};
  Outcome outcome{};
};

struct FalsifySettings {
  std::size_t runs = 2000;        // of all spaces together
  std::size_t runs_a_round = 40;  // of each space in one round
  std::uint64_t seed = 1;
  Optimiser optimiser = Optimiser::kSubplex;
  bool until_broken = false;  // no further than the first that breaks what is asked
  std::string fingerprint{};  // of everything that decides an outcome
};

class FalsifySession {
 public:
  // Trials of `file` that bear the fingerprint are taken instead of running them again. Throws
  // std::system_error when the file cannot be written.
  FalsifySession(FalsifySettings settings, std::vector<FaultSpace> spaces,
                 const std::filesystem::path& file);

  // False when `stop` ended it. `told` after each trial; `goes_on` is asked before each that is not
  // known yet.
  bool run(Objective& objective, const std::function<bool()>& goes_on,
           const std::function<void(const FalsifySession&)>& told);

  [[nodiscard]] const std::vector<FaultSpace>& spaces() const noexcept { return spaces_; }
  [[nodiscard]] const std::vector<FalsifyTrial>& trials() const noexcept { return trials_; }
  // Of the smallest margin.
  [[nodiscard]] const FalsifyTrial* worst() const noexcept;

 private:
  [[nodiscard]] bool over() const noexcept;
  FalsifyTrial measured(std::size_t space, const BoxTrial& trial, Objective& objective);

  FalsifySettings settings_;
  std::vector<FaultSpace> spaces_;
  std::filesystem::path file_;
  std::vector<std::string> known_;  // lines of the file, in order
  std::vector<FalsifyTrial> trials_;
  std::optional<std::size_t> worst_{};
};

}  // namespace towbench::harness

// One search over several spaces, kept in a file as it goes: what was interrupted is continued,
// with the same trials.
//
// In rounds: half of a round's runs are samples (box_sampler.h), one of each space in turn, in an
// order that is drawn and comes to every fault soon; the others go to the goals that came nearest
// (search_goals.h), where the optimiser begins at the best samples at which it has not begun yet.
// What no goal takes is sampled.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "harness/falsify/box_search.h"
#include "harness/falsify/falsify_trial.h"
#include "harness/falsify/search_goals.h"
#include "harness/falsify/search_space.h"

namespace towbench::harness {

struct FalsifySettings {
  std::size_t runs = 2000;        // of all spaces together
  std::size_t runs_a_round = 40;  // times the number of spaces
  std::uint64_t seed = 1;
  Optimiser optimiser = Optimiser::kSubplex;
  bool until_broken = false;  // no further than the first that breaks what is asked
  std::string fingerprint{};  // of everything that decides an outcome
};

class FalsifySession {
 public:
  // Trials of `file` that bear the fingerprint are taken instead of running them again. Throws
  // std::system_error when the file cannot be written.
  FalsifySession(FalsifySettings settings, std::vector<SearchSpace> spaces,
                 const std::filesystem::path& file);

  // `objectives`: of each experiment. False when `goes_on`, which is asked before each trial that
  // is not known yet, ended it. `told` after each trial.
  bool run(const std::vector<Objective*>& objectives, const std::function<bool()>& goes_on,
           const std::function<void(const FalsifySession&)>& told);
  // Takes the trials of another part of the same search.
  void add(const FalsifySession& part);

  [[nodiscard]] const std::vector<SearchSpace>& spaces() const noexcept { return spaces_; }
  [[nodiscard]] const std::vector<FalsifyTrial>& trials() const noexcept { return trials_; }
  // Of the smallest margin.
  [[nodiscard]] const FalsifyTrial* worst() const noexcept;

 private:
  using Measure = std::function<void(std::size_t space, const BoxTrial&)>;

  [[nodiscard]] bool over() const noexcept;
  void search(std::uint64_t round, const Measure& measure);
  // Until there are so many trials, from that turn of the order on.
  void sample(std::size_t until, const std::vector<std::size_t>& order, std::size_t& turn,
              const Measure& measure);
  [[nodiscard]] std::vector<BoxTrial> samples_for(const SearchGoal& goal) const;
  FalsifyTrial measured(std::size_t space, const BoxTrial& trial, Objective& objective);
  void take(FalsifyTrial trial);

  FalsifySettings settings_;
  std::vector<SearchSpace> spaces_;
  std::filesystem::path file_;
  std::vector<std::string> known_;  // lines of the file, in order
  std::vector<FalsifyTrial> trials_;
  std::optional<std::size_t> worst_{};
  std::vector<BoxSampler> samplers_;                     // of each space
  std::map<SearchGoal, std::vector<BoxPoint>> begun_{};  // where the optimiser has begun
};

}  // namespace towbench::harness

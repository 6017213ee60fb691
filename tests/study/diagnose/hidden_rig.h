// A rig file with something in it other than its plant file says, and a log of it: what a person
// with a machine that does not behave brings to the bench.
#pragma once

#include <filesystem>
#include <string>

namespace towbench::tests {

class HiddenRig {
 public:
  // `stated`: the plant that the rig names; `hidden`: TOML that goes into its [axis.y].
  HiddenRig(const std::filesystem::path& stated, const std::string& hidden);
  HiddenRig(const HiddenRig&) = delete;
  HiddenRig& operator=(const HiddenRig&) = delete;
  ~HiddenRig();

  [[nodiscard]] const std::filesystem::path& folder() const noexcept { return folder_; }
  [[nodiscard]] std::filesystem::path file() const { return folder_ / "rig.toml"; }
  // Runs the console of an experiment file on this rig; returns the run folder.
  [[nodiscard]] std::filesystem::path log_of(const std::filesystem::path& experiment) const;

 private:
  std::filesystem::path folder_;
};

}  // namespace towbench::tests

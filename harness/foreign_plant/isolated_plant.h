// A foreign plant in a process of its own: what it does wrong ends in one line, never in the bench.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <sys/types.h>

#include "emulator/foreign/foreign_plant.h"
#include "harness/foreign_plant/loaded_plant.h"
#include "harness/foreign_plant/mailbox.h"

namespace towbench::harness {

struct PlantFile {
  std::string name;  // as the rig names it, for messages
  std::shared_ptr<const PlantBinary> binary;
  double answer_limit_s = 2.0;  // of the host's clock; then it counts as blocked
};

class IsolatedPlant final : public emulator::ForeignPlant {
 public:
  // Never throws for what the binary does: failure() has it.
  IsolatedPlant(PlantFile file, const core::PerAxis<std::optional<double>>& starts_m);
  ~IsolatedPlant() override;

  // Refused, besides what the binary itself reports: an end of its process, no answer in time,
  // values that are not finite or too large, another time than the one asked for, a load that does
  // not rest at its start.
  [[nodiscard]] bool step(double until_s, const core::PerAxis<emulator::ForeignInput>& inputs,
                          core::PerAxis<emulator::ForeignOutput>& outputs) noexcept override;
  [[nodiscard]] const std::string& failure() const noexcept override { return failure_; }

  // A process that is forked goes on with a plant of its own, from the state saved here before.
  void before_fork() noexcept;
  void in_forked_process() noexcept;

 private:
  void start();
  void go_on_in_forked_process();
  void share_priority() const noexcept;
  [[nodiscard]] bool order(PlantOrder what);
  [[nodiscard]] bool answer_comes();
  [[nodiscard]] bool is_sound(double until_s);
  void put(const core::PerAxis<emulator::ForeignInput>& inputs);
  void take(core::PerAxis<emulator::ForeignOutput>& outputs) const;
  void fail(const std::string& why);
  void end_host(bool politely) noexcept;

  PlantFile file_;
  std::vector<core::Axis> order_;
  std::vector<PlantAxis> axes_;
  SharedMailbox mailbox_;
  pid_t host_ = -1;
  std::uint32_t turn_ = 0;
  double time_s_ = 0;
  std::string failure_;
  std::vector<std::byte> saved_;
  bool is_copy_ = false;  // of a plant whose process belongs to the one that was forked
};

// A source whose plants are of one file.
[[nodiscard]] std::shared_ptr<const emulator::ForeignPlantSource> make_plant_source(PlantFile file);

}  // namespace towbench::harness

// A tow experiment (1.2.2, ch. 8): as Procedure, but with loads that are exchanged between runs.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "study/identify/tow/rigid_model.h"
#include "study/procedures/procedure.h"
#include "study/procedures/tow/tow_loads.h"

namespace towbench::study::procedures {

struct TowContext {
  const TowLoads& loads;
  std::filesystem::path settings{};  // the experiment's own file; what it leaves out has defaults
  std::function<void(double share)> progress{};

  void tell(double share) const {
    if (progress) {
      progress(share);
    }
  }
};

// Drag predicted by a model without friction by place: the stretches from which the judge computes
// its bias.
struct BlindPrediction {
  std::string quantity;
  std::vector<identify::TowStretch> identified;  // what the model rests on
  std::vector<identify::TowStretch> towed;       // what it was asked to predict
};

struct TowOutcome : ProcedureOutcome {
  std::vector<BlindPrediction> blind{};
};

class TowProcedure {
 public:
  TowProcedure() = default;
  TowProcedure(const TowProcedure&) = delete;
  TowProcedure& operator=(const TowProcedure&) = delete;
  virtual ~TowProcedure() = default;

  [[nodiscard]] virtual std::string_view id() const noexcept = 0;  // EXP-1; also its file's name
  [[nodiscard]] virtual std::string_view title() const noexcept = 0;
  // Throws FixtureError for a settings file that run() could not use.
  virtual void check_settings(const std::filesystem::path& file) const = 0;
  // What is towed: whose truth its estimates are judged by.
  [[nodiscard]] virtual Load load() const = 0;
  // Throws FixtureError for a settings file that cannot be used.
  [[nodiscard]] virtual TowOutcome run(const TowContext& context) const = 0;
};

[[nodiscard]] std::unique_ptr<TowProcedure> straight_drag();    // EXP-1
[[nodiscard]] std::unique_ptr<TowProcedure> curved_drag();      // EXP-2
[[nodiscard]] std::unique_ptr<TowProcedure> drag_at_yaw();      // EXP-3
[[nodiscard]] std::unique_ptr<TowProcedure> manoeuvres();       // EXP-4
[[nodiscard]] std::unique_ptr<TowProcedure> fin_thrust();       // EXP-5
[[nodiscard]] std::unique_ptr<TowProcedure> subtraction();      // subtraction
[[nodiscard]] std::unique_ptr<TowProcedure> added_mass();       // added-mass
[[nodiscard]] std::unique_ptr<TowProcedure> loaded_tracking();  // load

[[nodiscard]] std::vector<std::unique_ptr<TowProcedure>> tow_procedures();

inline TowOutcome tow_refused(std::string why) {
  TowOutcome outcome;
  outcome.status = ProcedureOutcome::Status::kRefused;
  outcome.reason = std::move(why);
  return outcome;
}
inline TowOutcome tow_failed(std::string how) {
  TowOutcome outcome;
  outcome.status = ProcedureOutcome::Status::kFailed;
  outcome.reason = std::move(how);
  return outcome;
}

}  // namespace towbench::study::procedures

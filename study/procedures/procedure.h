// One experiment as a procedure: refuses what cannot work before anything moves, runs, estimates.
//
// A procedure sees the machine through its controller and sensors, what documents say of it
// (Nameplate), and what was estimated before. It never sees what the machine truly is: agreement
// with that is judged afterwards, by recovery/recovery.h.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "study/identify/estimate.h"
#include "study/procedures/figure.h"
#include "study/procedures/machine.h"

namespace towbench::study::procedures {

struct ProcedureContext {
  const Machine& machine;
  core::Axis axis = core::Axis::kY;
  std::filesystem::path settings{};  // the procedure's own file; what it leaves out has defaults
  identify::Estimates known{};       // by the procedures before, of all axes
  // Says how far it is, 0 to 1. May be empty.
  std::function<void(double share)> progress{};

  // What is known of this axis, or null.
  [[nodiscard]] const identify::Estimate* find(std::string_view quantity) const noexcept {
    return identify::find(known, quantity, core::name_of(axis));
  }
  void tell(double share) const {
    if (progress) {
      progress(share);
    }
  }
};

struct ProcedureOutcome {
  enum class Status {
    kDone,
    kRefused,  // before anything moved; `reason` says why
    kFailed,   // the run or its data are no good; `reason` says how
  };
  Status status = Status::kDone;
  std::string reason{};
  identify::Estimates estimates{};
  identify::Estimates withheld{};  // not to be used: the data do not tell them
  std::vector<ResultTable> tables{};
  std::vector<Figure> figures{};
  double simulated_s = 0;

  [[nodiscard]] static ProcedureOutcome refused(std::string why) {
    ProcedureOutcome outcome;
    outcome.status = Status::kRefused;
    outcome.reason = std::move(why);
    return outcome;
  }
  [[nodiscard]] static ProcedureOutcome failed(std::string how) {
    ProcedureOutcome outcome;
    outcome.status = Status::kFailed;
    outcome.reason = std::move(how);
    return outcome;
  }
};

class Procedure {
 public:
  Procedure() = default;
  Procedure(const Procedure&) = delete;
  Procedure& operator=(const Procedure&) = delete;
  virtual ~Procedure() = default;

  [[nodiscard]] virtual std::string_view id() const noexcept = 0;  // EXP-P-3; also its file's name
  [[nodiscard]] virtual std::string_view title() const noexcept = 0;
  // Throws FixtureError for a settings file that run() could not use.
  virtual void check_settings(const std::filesystem::path& file) const = 0;
  // Throws FixtureError for a settings file that cannot be used.
  [[nodiscard]] virtual ProcedureOutcome run(const ProcedureContext& context) const = 0;
};

// Of the identification, in the order in which they build on one another.
[[nodiscard]] std::vector<std::unique_ptr<Procedure>> identification_procedures();

}  // namespace towbench::study::procedures

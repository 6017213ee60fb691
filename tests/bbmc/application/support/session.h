// A person at the console of a tabletop machine.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "bbmc/application/application.h"
#include "bbmc/device/device_manager.h"
#include "bbmc/system/system_manager.h"
#include "tests/bbmc/application/support/tabletop.h"

namespace towbench::bbmc::testing {

class Session {
 public:
  explicit Session(std::size_t log_rows = 20'000, core::PerPlanarAxis<bool> axes = {{true, true}});

  // Types a line, lets the machine run until the console is idle again, and returns what came back
  // (echo is off), without the prompt.
  std::string enter(std::string_view line);
  // The same without waiting: machine time goes on by `for_s`.
  std::string type(std::string_view bytes, double for_s);
  void run(double for_s);
  // Everything that came back since it was last asked for.
  std::string heard();

  [[nodiscard]] SystemManager& system() { return *system_; }
  [[nodiscard]] const SystemStatus& status() const { return system_->status(); }
  [[nodiscard]] Application& application() { return *application_; }
  [[nodiscard]] Tabletop& machine() { return *machine_; }

  // The axes that there are, declared at a place far from every end.
  void calibrate();

 private:
  static constexpr core::Nanoseconds kExchange_ns = core::kNanosecondsPerMillisecond;

  void exchange();

  std::unique_ptr<Tabletop> machine_;
  std::unique_ptr<DeviceManager> devices_;
  std::vector<DataLogRow> log_;
  std::unique_ptr<SystemManager> system_;
  std::unique_ptr<Application> application_;
};

}  // namespace towbench::bbmc::testing

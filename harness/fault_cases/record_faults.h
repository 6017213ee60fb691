// What happens to the host that writes the record, done for real: the kernel refuses to let a file
// grow, or ends the process.
#pragma once

#include <filesystem>

#include <sys/resource.h>

#include "harness/link/time_watcher.h"
#include "harness/lockstep/host_schedule.h"
#include "harness/record/controller_recorder.h"

namespace towbench::harness {

class RecordFaults final : public TimeWatcher {
 public:
  // Of the record in `folder`, which `recorder` writes. Schedule and recorder outlive this.
  RecordFaults(const HostSchedule& host, std::filesystem::path folder,
               ControllerRecorder& recorder);
  // The disk has room again.
  ~RecordFaults() override;

  void runs_to(core::Nanoseconds until_ns) noexcept override;

 private:
  void fill_disk() noexcept;
  void free_disk() noexcept;

  const HostSchedule& host_;
  std::filesystem::path folder_;
  ControllerRecorder& recorder_;
  bool is_full_ = false;
  rlimit before_{};
};

}  // namespace towbench::harness

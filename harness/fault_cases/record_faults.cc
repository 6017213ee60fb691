#include "harness/fault_cases/record_faults.h"

#include <algorithm>
#include <csignal>
#include <system_error>

#include <unistd.h>

namespace towbench::harness {

RecordFaults::RecordFaults(const HostSchedule& host, std::filesystem::path folder,
                           ControllerRecorder& recorder)
    : host_(host), folder_(std::move(folder)), recorder_(recorder) {
  if (!host_.full_disks.empty()) {
    // A write beyond the limit then fails, as on a full disk. By default the signal ends the
    // process.
    (void)std::signal(SIGXFSZ, SIG_IGN);
  }
}

RecordFaults::~RecordFaults() {
  free_disk();
}

void RecordFaults::runs_to(core::Nanoseconds until_ns) noexcept {
  if (host_.killed_ns && until_ns >= *host_.killed_ns) {
    recorder_.catch_up();
    (void)kill(getpid(), SIGKILL);
  }
  const bool full = std::any_of(
      host_.full_disks.begin(), host_.full_disks.end(),
      [&](const FullDisk& disk) { return until_ns >= disk.from_ns && until_ns < disk.until_ns; });
  if (full && !is_full_) {
    fill_disk();
  } else if (!full && is_full_) {
    free_disk();
  }
}

// The limit is the length of the log at this moment: no file of this process may grow beyond it.
void RecordFaults::fill_disk() noexcept {
  recorder_.catch_up();
  std::error_code error;
  const auto size = std::filesystem::file_size(folder_ / "log.csv", error);
  rlimit limit{};
  if (error || getrlimit(RLIMIT_FSIZE, &limit) != 0) {
    return;  // no write is refused, so the fault counts as not fired
  }
  before_ = limit;
  limit.rlim_cur = size;
  is_full_ = setrlimit(RLIMIT_FSIZE, &limit) == 0;
}

void RecordFaults::free_disk() noexcept {
  if (is_full_) {
    (void)setrlimit(RLIMIT_FSIZE, &before_);
    is_full_ = false;
  }
}

}  // namespace towbench::harness

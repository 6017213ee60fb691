#include "harness/realtime/host_findings.h"

#include <algorithm>
#include <ctime>
#include <fstream>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sched.h>
#include <sys/resource.h>
#include <sys/utsname.h>
#include <unistd.h>

namespace towbench::harness {
namespace {

namespace fs = std::filesystem;

std::string first_line(const fs::path& path) {
  std::ifstream stream(path);
  std::string line;
  std::getline(stream, line);
  return line;
}

std::vector<std::string> names_in(const fs::path& folder, std::string_view prefix) {
  std::vector<std::string> names;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    if (const auto name = entry.path().filename().string(); name.starts_with(prefix)) {
      names.push_back(name);
    }
  }
  std::sort(names.begin(), names.end());
  return names;
}

std::string listed(const std::vector<std::string>& names) {
  return fmt::format("{}", fmt::join(names, " "));
}

Finding kernel() {
  utsname name{};
  ::uname(&name);
  const std::string version = name.version;
  if (version.find("PREEMPT_RT") != std::string::npos) {
    return {"kernel", Fitness::kGood,
            fmt::format("{}, fully preemptible: fit for 10 kHz", name.release), ""};
  }
  const bool preemptible = version.find("PREEMPT") != std::string::npos;
  return {"kernel", Fitness::kLimited,
          fmt::format("{}, {}: fit for 10 kHz with rare ticks that come late", name.release,
                      preemptible ? "preemptible" : "not preemptible"),
          "a PREEMPT_RT kernel (Debian: linux-image-rt-amd64) bounds the lateness"};
}

Finding scheduler() {
  rlimit limit{};
  ::getrlimit(RLIMIT_RTPRIO, &limit);
  constexpr rlim_t kWanted = 80;
  // Trying is the only certain way; it is taken back at once.
  sched_param parameters{};
  const int before = ::sched_getscheduler(0);
  parameters.sched_priority = static_cast<int>(kWanted);
  if (::sched_setscheduler(0, SCHED_FIFO, &parameters) == 0) {
    parameters.sched_priority = 0;
    (void)::sched_setscheduler(0, before == SCHED_FIFO ? SCHED_OTHER : before, &parameters);
    return {"scheduler", Fitness::kGood, "SCHED_FIFO 80 is granted", ""};
  }
  return {"scheduler", Fitness::kMissing,
          fmt::format("SCHED_FIFO is refused (rtprio limit {}): ticks wait for other processes",
                      limit.rlim_cur),
          "run as root, or `rtprio 80` for the user in /etc/security/limits.conf"};
}

Finding memory() {
  rlimit limit{};
  ::getrlimit(RLIMIT_MEMLOCK, &limit);
  constexpr rlim_t kWanted = rlim_t{256} << 20U;
  if (::geteuid() == 0 || limit.rlim_cur >= kWanted) {
    return {"memory", Fitness::kGood, "may be locked", ""};
  }
  return {
      "memory", Fitness::kLimited,
      fmt::format("only {} KiB may be locked: page faults may delay a tick", limit.rlim_cur / 1024),
      "`memlock unlimited` for the user in /etc/security/limits.conf"};
}

Finding timer(const fs::path& root) {
  timespec resolution{};
  ::clock_getres(CLOCK_MONOTONIC, &resolution);
  const auto source =
      first_line(root / "sys/devices/system/clocksource/clocksource0/current_clocksource");
  if (resolution.tv_sec == 0 && resolution.tv_nsec <= 1000) {
    return {"timer", Fitness::kGood,
            fmt::format("resolution {} ns, clock source {}", resolution.tv_nsec,
                        source.empty() ? "not told" : source),
            ""};
  }
  return {"timer", Fitness::kMissing,
          fmt::format("resolution {} ns: too coarse for 10 kHz", resolution.tv_nsec),
          "a kernel with high-resolution timers (boot without highres=off)"};
}

Finding processors(const fs::path& root) {
  const long online = ::sysconf(_SC_NPROCESSORS_ONLN);
  const auto isolated = first_line(root / "sys/devices/system/cpu/isolated");
  if (online < 2) {
    return {"processors", Fitness::kLimited, "one: both sides and everything else share it",
            "a second processor"};
  }
  if (isolated.empty()) {
    return {"processors", Fitness::kLimited,
            fmt::format("{}, none isolated: other processes share those of the loops", online),
            fmt::format("boot with isolcpus={} nohz_full={} rcu_nocbs={}", online - 1, online - 1,
                        online - 1)};
  }
  return {"processors", Fitness::kGood, fmt::format("{}, isolated: {}", online, isolated), ""};
}

Finding can(const fs::path& root) {
  // The kernel's number for a network device that is a CAN controller, real or virtual.
  constexpr std::string_view kTypeCan = "280";
  std::vector<std::string> up;
  std::vector<std::string> down;
  for (const auto& name : names_in(root / "sys/class/net", "")) {
    const auto folder = root / "sys/class/net" / name;
    if (first_line(folder / "type") == kTypeCan) {
      const auto state = first_line(folder / "operstate");
      const bool fd = first_line(folder / "mtu") == "72";
      (state == "down" ? down : up).push_back(name + (fd ? " (FD)" : ""));
    }
  }
  if (!up.empty()) {
    return {"can", Fitness::kGood,
            "up: " + listed(up) + (down.empty() ? "" : "; down: " + listed(down)), ""};
  }
  if (!down.empty()) {
    return {"can", Fitness::kMissing, "down: " + listed(down),
            "ip link set " + down.front().substr(0, down.front().find(' ')) +
                " up type can bitrate 1000000 restart-ms 100"};
  }
  return {"can", Fitness::kMissing, "no CAN interface",
          "plug one in, or `modprobe vcan; ip link add vcan0 type vcan; ip link set vcan0 up`"};
}

Finding gpio(const fs::path& root) {
  const auto chips = names_in(root / "dev", "gpiochip");
  if (chips.empty()) {
    return {"gpio", Fitness::kMissing, "no GPIO chip: lines go over the carrier",
            "a board with GPIO, or a USB adapter with a kernel driver"};
  }
  std::vector<std::string> closed;
  for (const auto& chip : chips) {
    if (::access((root / "dev" / chip).c_str(), R_OK | W_OK) != 0) {
      closed.push_back(chip);
    }
  }
  return closed.empty() ? Finding{"gpio", Fitness::kGood, listed(chips), ""}
                        : Finding{"gpio", Fitness::kLimited, "no right to open: " + listed(closed),
                                  "add the user to the group that owns /dev/gpiochip*"};
}

Finding serial(const fs::path& root) {
  std::vector<std::string> ports;
  for (const char* prefix : {"ttyUSB", "ttyACM", "ttyAMA", "ttyS"}) {
    for (const auto& name : names_in(root / "dev", prefix)) {
      // A port without hardware behind it has no driver of its own.
      const bool real =
          !name.starts_with("ttyS") || first_line(root / "sys/class/tty" / name / "type") != "0";
      if (real && ::access((root / "dev" / name).c_str(), R_OK | W_OK) == 0) {
        ports.push_back(name);
      }
    }
  }
  return ports.empty() ? Finding{"serial", Fitness::kMissing, "no serial port that may be opened",
                                 "plug one in; add the user to the group dialout"}
                       : Finding{"serial", Fitness::kGood, listed(ports), ""};
}

}  // namespace

std::vector<Finding> host_findings(const std::filesystem::path& root) {
  return {kernel(),         scheduler(), memory(),   timer(root),
          processors(root), can(root),   gpio(root), serial(root)};
}

}  // namespace towbench::harness

#include "harness/realtime/host_findings.h"

#include <algorithm>
#include <array>
#include <ctime>
#include <fstream>

#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <linux/gpio.h>
#include <sched.h>
#include <sys/ioctl.h>
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
  const bool by_choice = version.find("PREEMPT_DYNAMIC") != std::string::npos;
  const bool preemptible = version.find("PREEMPT") != std::string::npos;
  return {"kernel", Fitness::kLimited,
          fmt::format("{}, {}: fit for 10 kHz with rare ticks that come late", name.release,
                      by_choice     ? "preemptible as chosen at boot"
                      : preemptible ? "preemptible"
                                    : "not preemptible"),
          fmt::format("a PREEMPT_RT kernel (Debian: linux-image-rt-amd64) bounds the lateness{}",
                      by_choice ? "; boot with preempt=full lowers it" : "")};
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
    return {"scheduler", Fitness::kGood,
            "SCHED_FIFO 80 is granted: the loops go before other processes", ""};
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
    return {"memory", Fitness::kGood, "may be locked: no page fault delays a tick", ""};
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
            fmt::format("resolution {} ns, clock source {}: fit for 10 kHz", resolution.tv_nsec,
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
  return {"processors", Fitness::kGood,
          fmt::format("{}, isolated for the loops: {}", online, isolated), ""};
}

// A network device that is a CAN controller.
struct CanInterface {
  std::string name;
  bool is_up = false;
  bool is_virtual = false;
  bool has_fd = false;

  [[nodiscard]] std::string text() const {
    const bool both = is_virtual && has_fd;
    return name + (both ? " (virtual, FD)" : is_virtual ? " (virtual)" : has_fd ? " (FD)" : "");
  }
};

std::vector<CanInterface> can_interfaces(const fs::path& root) {
  // The kernel's number for a CAN controller, real or virtual.
  constexpr std::string_view kTypeCan = "280";
  std::vector<CanInterface> interfaces;
  for (const auto& name : names_in(root / "sys/class/net", "")) {
    const auto folder = root / "sys/class/net" / name;
    if (first_line(folder / "type") == kTypeCan) {
      interfaces.push_back({.name = name,
                            .is_up = first_line(folder / "operstate") != "down",
                            .is_virtual = name.starts_with("vcan") || name.starts_with("vxcan"),
                            .has_fd = first_line(folder / "mtu") == "72"});
    }
  }
  return interfaces;
}

Finding can(const fs::path& root) {
  std::vector<std::string> up;
  std::vector<std::string> down;
  std::string remedy;
  bool has_wire = false;
  for (const auto& each : can_interfaces(root)) {
    (each.is_up ? up : down).push_back(each.text());
    has_wire = has_wire || (each.is_up && !each.is_virtual);
    if (!each.is_up && remedy.empty()) {
      remedy = "ip link set " + each.name + " up" +
               (each.is_virtual ? "" : " type can bitrate 1000000 restart-ms 100");
    }
  }
  if (up.empty() && down.empty()) {
    return {"can", Fitness::kMissing, "no CAN interface: nothing goes over CAN",
            "plug one in, or `modprobe vcan; ip link add vcan0 type vcan; ip link set vcan0 up`"};
  }
  if (up.empty()) {
    return {"can", Fitness::kMissing, "down: " + listed(down) + ": nothing goes over CAN", remedy};
  }
  const auto found = "up: " + listed(up) + (down.empty() ? "" : "; down: " + listed(down));
  if (!has_wire) {
    return {"can", Fitness::kLimited, found + ": fit for two sides on this host, no wire",
            remedy.empty() ? "plug a CAN adapter in for a board" : remedy};
  }
  return {"can", Fitness::kGood, found + ": fit for the digest of two axes at 1 kHz and 1 Mbit/s",
          ""};
}

// "gpiochip0 (54 lines)"; without the number where the kernel does not tell.
std::string with_lines(const fs::path& chip) {
  gpiochip_info about{};
  const int descriptor = ::open(chip.c_str(), O_RDWR | O_CLOEXEC);
  const bool told = descriptor >= 0 && ::ioctl(descriptor, GPIO_GET_CHIPINFO_IOCTL, &about) == 0;
  if (descriptor >= 0) {
    ::close(descriptor);
  }
  const auto name = chip.filename().string();
  return told ? fmt::format("{} ({} lines)", name, about.lines) : name;
}

// Devices that may be opened, and those that may not.
struct Devices {
  std::vector<std::string> open;
  std::vector<std::string> closed;
};

Finding gpio(const fs::path& root) {
  Devices chips;
  for (const auto& chip : names_in(root / "dev", "gpiochip")) {
    const bool may = ::access((root / "dev" / chip).c_str(), R_OK | W_OK) == 0;
    (may ? chips.open : chips.closed).push_back(may ? with_lines(root / "dev" / chip) : chip);
  }
  if (chips.open.empty() && chips.closed.empty()) {
    return {"gpio", Fitness::kMissing, "no GPIO chip: lines go over the carrier",
            "a board with GPIO, or a USB adapter with a kernel driver"};
  }
  if (!chips.closed.empty()) {
    return {"gpio", chips.open.empty() ? Fitness::kMissing : Fitness::kLimited,
            (chips.open.empty() ? "" : listed(chips.open) + "; ") +
                std::string("no right to open: ") + listed(chips.closed),
            "add the user to the group that owns /dev/gpiochip*"};
  }
  return {"gpio", Fitness::kGood,
          listed(chips.open) + ": fit for --lines (9 lines) and --encoder-lines (4, 6 with index)",
          ""};
}

// A port without hardware behind it has no driver of its own.
bool is_serial_port(const fs::path& root, const std::string& name) {
  constexpr std::array kPrefixes{"ttyUSB", "ttyACM", "ttyAMA", "ttyO", "ttymxc", "ttyTHS"};
  const bool named = std::any_of(kPrefixes.begin(), kPrefixes.end(),
                                 [&](const char* prefix) { return name.starts_with(prefix); });
  return named ||
         (name.starts_with("ttyS") && first_line(root / "sys/class/tty" / name / "type") != "0");
}

Finding serial(const fs::path& root) {
  Devices ports;
  for (const auto& name : names_in(root / "dev", "tty")) {
    if (is_serial_port(root, name)) {
      const bool may = ::access((root / "dev" / name).c_str(), R_OK | W_OK) == 0;
      (may ? ports.open : ports.closed).push_back(name);
    }
  }
  if (ports.open.empty() && ports.closed.empty()) {
    return {"serial", Fitness::kMissing, "no serial port: only serial-pty goes over serial",
            "plug one in"};
  }
  if (ports.open.empty()) {
    return {"serial", Fitness::kMissing, "no right to open: " + listed(ports.closed),
            "add the user to the group dialout"};
  }
  return {"serial", Fitness::kGood,
          listed(ports.open) +
              ": fit for a console; for the digest of two axes at 1 kHz from "
              "1,177,500 baud on",
          ""};
}

}  // namespace

std::vector<Finding> host_findings(const std::filesystem::path& root) {
  return {kernel(),         scheduler(), memory(),   timer(root),
          processors(root), can(root),   gpio(root), serial(root)};
}

}  // namespace towbench::harness

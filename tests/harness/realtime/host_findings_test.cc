#include "harness/realtime/host_findings.h"

#include <algorithm>
#include <fstream>

#include <gtest/gtest.h>

#include "harness/realtime/own_lateness.h"
#include "tests/harness/fixtures/temporary_fixtures.h"

namespace towbench::harness {
namespace {

Finding finding_on(const TemporaryFixtures& root, const std::string& subject) {
  const auto findings = host_findings(root.folder());
  const auto found = std::find_if(findings.begin(), findings.end(),
                                  [&](const Finding& each) { return each.subject == subject; });
  return found == findings.end() ? Finding{} : *found;
}

TEST(HostFindings, SayOneThingOfEverySubjectAndHowToCorrectWhatIsMissing) {
  const auto findings = host_findings();
  EXPECT_EQ(findings.size(), 8U);
  for (const auto& finding : findings) {
    EXPECT_FALSE(finding.found.empty()) << finding.subject;
    EXPECT_EQ(finding.fit == Fitness::kGood, finding.remedy.empty()) << finding.subject;
  }
}

TEST(HostFindings, TellCanInterfacesByTypeAndState) {
  const TemporaryFixtures root;
  EXPECT_EQ(finding_on(root, "can").fit, Fitness::kMissing);
  root.write("sys/class/net/eth0/type", "1\n");
  root.write("sys/class/net/can0/type", "280\n");
  root.write("sys/class/net/can0/operstate", "down\n");
  root.write("sys/class/net/can0/mtu", "16\n");
  const auto down = finding_on(root, "can");
  EXPECT_EQ(down.fit, Fitness::kMissing);
  EXPECT_EQ(down.remedy, "ip link set can0 up type can bitrate 1000000 restart-ms 100");
  root.write("sys/class/net/vcan0/type", "280\n");
  root.write("sys/class/net/vcan0/operstate", "unknown\n");
  root.write("sys/class/net/vcan0/mtu", "72\n");
  const auto virtual_only = finding_on(root, "can");
  EXPECT_EQ(virtual_only.found,
            "up: vcan0 (virtual, FD); down: can0: fit for two sides on this host, no wire");
  EXPECT_EQ(virtual_only.fit, Fitness::kLimited);
  root.write("sys/class/net/can0/operstate", "up\n");
  EXPECT_EQ(finding_on(root, "can").fit, Fitness::kGood);
}

TEST(HostFindings, DoNotGiveAVirtualBusABitRateToCorrectIt) {
  const TemporaryFixtures root;
  root.write("sys/class/net/vcan0/type", "280\n");
  root.write("sys/class/net/vcan0/operstate", "down\n");
  EXPECT_EQ(finding_on(root, "can").remedy, "ip link set vcan0 up");
}

TEST(HostFindings, TellSerialPortsWithHardwareBehindThem) {
  const TemporaryFixtures root;
  EXPECT_EQ(finding_on(root, "serial").fit, Fitness::kMissing);
  root.write("dev/ttyS0", "");
  root.write("sys/class/tty/ttyS0/type", "0\n");
  root.write("dev/tty1", "");
  EXPECT_EQ(finding_on(root, "serial").fit, Fitness::kMissing);
  root.write("dev/ttyO2", "");
  const auto found = finding_on(root, "serial");
  EXPECT_EQ(found.fit, Fitness::kGood);
  EXPECT_TRUE(found.found.starts_with("ttyO2: fit for")) << found.found;
}

TEST(HostFindings, TellGpioChipsAndIsolatedProcessors) {
  const TemporaryFixtures root;
  EXPECT_EQ(finding_on(root, "gpio").fit, Fitness::kMissing);
  root.write("dev/gpiochip0", "");
  const auto chip = finding_on(root, "gpio");
  EXPECT_EQ(chip.fit, Fitness::kGood);
  EXPECT_TRUE(chip.found.starts_with("gpiochip0: fit for --lines")) << chip.found;
}

TEST(LatenessFinding, NamesTheFastestRateThatTheHostIsFitFor) {
  const RealtimeBudget budget{.jitter_p999_max_ratio = 0.05, .source = "a file"};
  TickSummary summary;
  summary.ticks = 1000;
  summary.lateness.p50_ns = 30'000;
  summary.lateness.p999_ns = 34'000;
  EXPECT_EQ(lateness_finding(summary, budget).fit, Fitness::kGood);
  summary.lateness.p999_ns = 70'000;
  EXPECT_EQ(lateness_finding(summary, budget).fit, Fitness::kLimited);
  summary.lateness.p999_ns = 530'000;
  const auto late = lateness_finding(summary, budget);
  EXPECT_EQ(late.fit, Fitness::kMissing);
  EXPECT_NE(late.found.find("fit for controllers up to 100 Hz"), std::string::npos) << late.found;
  summary.ticks = 999;
  summary.lateness.p999_ns = 34'000;
  EXPECT_EQ(lateness_finding(summary, budget).fit, Fitness::kMissing)
      << "too little measured is no fitness";
}

}  // namespace
}  // namespace towbench::harness

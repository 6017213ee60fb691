// What goes on from a snapshot is the run that was never interrupted, and with a fault the run that
// was planned with it: every field of every record.
#include "harness/snapshots/snapshots.h"

#include <algorithm>
#include <bit>
#include <cstdlib>
#include <filesystem>
#include <random>

#include <gtest/gtest.h>

#include "harness/fault_cases/case_run.h"
#include "harness/fault_cases/fault_case.h"
#include "harness/fault_plan/fault_text.h"

namespace towbench::harness {
namespace {

class Digest {
 public:
  void add(std::uint64_t word) {
    value_ = (value_ ^ word) * 0x100000001b3U;
    value_ ^= value_ >> 31U;
  }
  void add(double number) { add(std::bit_cast<std::uint64_t>(number)); }
  void add(const std::string& text) {
    for (const char letter : text) {
      add(std::uint64_t{static_cast<unsigned char>(letter)});
    }
  }
  void time(core::Nanoseconds time_ns) { add(static_cast<std::uint64_t>(time_ns)); }
  [[nodiscard]] std::string text() const { return std::to_string(value_); }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325U;
};

void add_truth(Digest& digest, const CaseRecord& run) {
  for (const auto& row : run.truth) {
    digest.time(row.time_ns);
    digest.add(std::uint64_t{row.input_lines});
    for (const auto which : core::kPlanarAxes) {
      const auto& axis = row.axes[which];
      for (const double number : {axis.motor_angle_rad, axis.motor_speed_rad_per_s, axis.carriage_m,
                                  axis.carriage_speed_m_per_s, axis.current_A, axis.motor_torque_Nm,
                                  axis.motor_friction_Nm, axis.carriage_friction_N,
                                  axis.transmission_force_N, axis.command_V}) {
        digest.add(number);
      }
      digest.time(axis.count);
      digest.time(axis.edges_total);
    }
  }
}

void add_log(Digest& digest, const CaseRecord& run) {
  for (const auto& row : run.log) {
    digest.time(row.time_ns);
    digest.time(core::number_of(row.fault));
    for (const auto which : core::kPlanarAxes) {
      const auto& axis = row.axes[which];
      for (const double number : {axis.reference_m, axis.reference_velocity_m_per_s,
                                  axis.position_m, axis.velocity_m_per_s, axis.duty_pct}) {
        digest.add(number);
      }
      digest.time(axis.count);
      digest.time(axis.edges);
      digest.time(static_cast<int>(axis.mode));
    }
  }
}

void add_messages(Digest& digest, const CaseRecord& run) {
  for (const auto& arrived : run.arrivals) {
    digest.time(arrived.time_ns);
    digest.add(arrived.digest);
  }
  for (const auto& duty : run.duties) {
    digest.time(duty.time_ns);
    digest.add(duty.duty);
    digest.time(duty.enable ? 1 : 0);
  }
  for (const auto& line : run.lines) {
    digest.time(line.served_ns);
    digest.time(line.change_ns);
    digest.time(line.lines);
  }
}

std::string digest_of(const CaseRecord& run) {
  Digest digest;
  add_truth(digest, run);
  add_log(digest, run);
  add_messages(digest, run);
  for (const auto& event : run.plant_events) {
    digest.time(event.time_ns);
    digest.time(static_cast<int>(event.kind));
    digest.add(event.value);
  }
  for (const auto& event : run.controller_events) {
    digest.time(event.time_ns);
    digest.time(static_cast<int>(event.kind));
    digest.time(core::number_of(event.code));
    digest.time(event.value);
  }
  for (const auto& printed : run.printed) {
    digest.time(printed.time_ns);
    digest.add(printed.text);
  }
  digest.time(run.outcome.end_ns);
  digest.add(run.outcome.reason);
  return digest.text() + ' ' + std::to_string(run.truth.size()) + ' ' +
         std::to_string(run.log.size());
}

struct Motion {
  explicit Motion(const std::string& name)
      : plain(without_expectations(load_experiment("fixtures/experiments/" + name + ".toml"))),
        reference(run_reference(plain, 1)) {}
  ExperimentFixture plain;
  std::unique_ptr<CaseRecord> reference;

  [[nodiscard]] PreparedPlan prepared(const std::string& words) const {
    return prepare({parse_fault(words)}, plain, *reference);
  }
  [[nodiscard]] SnapshotWork work() const {
    return {.injection =
                [this](const std::string& words) {
                  return words == "none" ? Injection{} : prepared(words).injection;
                },
            .answer = [](const std::string&,
                         std::unique_ptr<CaseRecord> run) { return digest_of(*run); }};
  }
};

constexpr const char* kMotions[] = {"kill-1khz",    "trapezoid-400",       "circle",
                                    "one-axis",     "goto-pick-and-place", "pulses",
                                    "endstop-y-max"};
// One of every part, with what draws at random.
constexpr const char* kFaults[] = {"encoder.y noise_burst rate_Hz=9000",
                                   "encoder.y frozen",
                                   "encoder.y missing_edges",
                                   "kill_switch bounce",
                                   "amplifier.y gain_drop",
                                   "supply sag",
                                   "drive.y brake_drag force_N=40",
                                   "link.to_controller loss probability=0.2",
                                   "link.to_plant delay delay_s=0.004",
                                   "link.to_controller peer_restart",
                                   "host clock_step",
                                   "host stopped_process",
                                   "endstop.y_max stuck_closed",
                                   "link.to_controller flood messages=20"};

// `count` moments, each gone on from without a fault and with one that begins a little later.
void go_on_from_random_moments(const std::string& name, std::size_t count, unsigned seed) {
  const Motion motion(name);
  std::mt19937 random(seed);
  const auto end_ns = motion.reference->outcome.end_ns;
  std::vector<core::Nanoseconds> moments_ns;
  for (std::size_t i = 0; i < count; ++i) {
    moments_ns.push_back(static_cast<core::Nanoseconds>(random()) * 1000 % end_ns);
  }
  std::sort(moments_ns.begin(), moments_ns.end());
  Snapshots snapshots(motion.plain, 1, moments_ns, motion.work());
  const auto undisturbed = digest_of(*motion.reference);
  std::size_t differs = 0;
  for (const auto moment_ns : moments_ns) {
    ASSERT_EQ(snapshots.ask(moment_ns + core::kNanosecondsPerMillisecond + 1, "none"), undisturbed)
        << name << " at " << moment_ns;
    const auto words = std::string(kFaults[random() % std::size(kFaults)]) +
                       " at_s=" + std::to_string(core::seconds(moment_ns) + 1e-3) + " seed=5";
    const auto prepared = motion.prepared(words);
    const auto planned =
        digest_of(*run_case(motion.plain, prepared.built, prepared.injection, {.seed = 1}));
    ASSERT_EQ(snapshots.ask(prepared.onsets_ns.front(), words), planned) << name << ": " << words;
    differs += planned == undisturbed ? 0U : 1U;
  }
  EXPECT_GT(differs, 0U) << "no fault did anything";
}

class Snapshot : public ::testing::TestWithParam<const char*> {};

TEST_P(Snapshot, GoesOnAsTheRunThatWasNeverInterrupted) {
  go_on_from_random_moments(GetParam(), 6, 1);
}
INSTANTIATE_TEST_SUITE_P(Motions, Snapshot, ::testing::ValuesIn(kMotions), [](const auto& motion) {
  std::string name = motion.param;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
});

TEST(Snapshot, GoesOnAtAThousandMoments) {
  for (const char* name : kMotions) {
    for (unsigned seed = 10; seed < 13; ++seed) {
      go_on_from_random_moments(name, 48, seed);
    }
  }
}

TEST(Snapshot, OfWhichTheProcessEndsGivesNoAnswerAndTheNextOneDoes) {
  const Motion motion("kill-1khz");
  auto work = motion.work();
  work.answer = [](const std::string& words, std::unique_ptr<CaseRecord> run) {
    if (words != "none") {
      std::_Exit(9);
    }
    return digest_of(*run);
  };
  Snapshots snapshots(motion.plain, 1, {0}, work);
  EXPECT_EQ(snapshots.ask(0, "encoder.y frozen at_s=0.5"), std::nullopt);
  EXPECT_EQ(snapshots.ask(0, "none"), digest_of(*motion.reference));
}

TEST(Snapshot, IsNotTakenBeforeItsMoment) {
  const Motion motion("kill-1khz");
  Snapshots snapshots(motion.plain, 1, {core::kNanosecondsPerSecond}, motion.work());
  EXPECT_EQ(snapshots.ask(core::kNanosecondsPerSecond, "none"), std::nullopt);
  EXPECT_TRUE(snapshots.ask(core::kNanosecondsPerSecond + 1, "none"));
}

// A moment between two exchanges is saved at the second; a link lets through what is sent until
// then.
TEST(Snapshot, IsNotGoneOnFromForAFaultThatBeganBeforeItWasSaved) {
  const Motion motion("kill-1khz");
  Snapshots snapshots(motion.plain, 1, {500'000'000, 1'000'000'000, 1'000'300'000}, motion.work());
  for (const char* onset : {"1.0", "1.000000001", "1.0003", "1.0005", "1.001", "1.001000001"}) {
    const auto words = std::string("link.to_controller loss probability=0.5 seed=5 at_s=") + onset;
    const auto prepared = motion.prepared(words);
    EXPECT_EQ(snapshots.ask(prepared.onsets_ns.front(), words),
              digest_of(*run_case(motion.plain, prepared.built, prepared.injection, {.seed = 1})))
        << words;
  }
}

}  // namespace
}  // namespace towbench::harness

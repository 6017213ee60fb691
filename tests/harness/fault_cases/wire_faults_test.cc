// Every fault of a wire on every kind of wire, in both directions: both sides end in the documented
// safe state, or nothing happens at all. docs/reference/carriers.md shows it as a table.
#include <algorithm>
#include <map>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "harness/fault_cases/case_record.h"
#include "harness/fault_cases/case_run.h"
#include "harness/fault_plan/carrier_fit.h"
#include "harness/lockstep/lockstep_bench.h"
#include "harness/lockstep/script_loop.h"
#include "tests/harness/end_to_end/run_support.h"
#include "tests/harness/fault_cases/two_sides.h"

namespace towbench::harness {
namespace {

using core::Axis;
using core::ErrorCode;
using emulator::PlantEventKind;
using ::testing::AnyOf;

constexpr core::Nanoseconds kStruck_ns = 900 * core::kNanosecondsPerMillisecond;  // Y runs by then

enum class Latched : std::uint8_t { kNothing, kLost, kCorrupt, kEither };

struct Cell {
  WireName wire;
  bool to_plant;
  WireFault fault;
  Latched latched;
};

std::vector<ErrorCode> numbers_of(Latched latched) {
  switch (latched) {
    case Latched::kNothing:
      return {};
    case Latched::kLost:
      return {ErrorCode::kFaultLinkLost};
    case Latched::kCorrupt:
      return {ErrorCode::kFaultLinkCorrupt};
    case Latched::kEither:
      break;
  }
  return {ErrorCode::kFaultLinkLost, ErrorCode::kFaultLinkCorrupt};
}

const char* name_of(WireName wire) {
  constexpr std::array<const char*, 4> kNames{"socket", "line", "bus", "fd_bus"};
  return kNames[static_cast<std::size_t>(wire)];
}

const char* name_of(WireKind kind) {
  constexpr std::array<const char*, 10> kNames{"loss",       "duplicate", "reorder", "corruption",
                                               "flood",      "jitter",    "delay",   "babble",
                                               "disconnect", "bus_off"};
  return kNames[static_cast<std::size_t>(kind)];
}

std::unique_ptr<CaseRecord> run_over(WireName wire, const Cell* cell,
                                     core::PerAxis<bool>* still_driven = nullptr) {
  static const ExperimentFixture fixture = without_expectations(Runs::shipped("wall-clock-window"));
  auto record = std::make_unique<CaseRecord>();
  TwoSides sides(wire, fixture.rig.parameters, *record);
  if (cell != nullptr) {
    sides.strike_at(kStruck_ns, cell->fault, cell->to_plant);
  }
  LockstepBench bench(fixture.controller.configuration, fixture.rig.hash, sides, record.get());
  record->outcome = play(fixture.experiment, bench, *record, {}, RunEnd::kUndriven);
  for (const auto axis : core::kPlanarAxes) {
    if (still_driven != nullptr) {
      (*still_driven)[axis] = sides.controller_drives(axis);
    }
  }
  sides.controller_leaves();
  return record;
}

const CaseRecord& sound_run_over(WireName wire) {
  static std::map<WireName, std::unique_ptr<CaseRecord>> runs;
  auto& run = runs[wire];
  if (!run) {
    run = run_over(wire, nullptr);
  }
  return *run;
}

const emulator::PlantEvent* find(const CaseRecord& run, PlantEventKind kind) {
  const auto found =
      std::find_if(run.plant_events.begin(), run.plant_events.end(),
                   [&](const emulator::PlantEvent& event) { return event.kind == kind; });
  return found == run.plant_events.end() ? nullptr : &*found;
}

class WireFaults : public testing::TestWithParam<Cell> {};

TEST_P(WireFaults, LeaveBothSidesSafeOrChangeNothing) {
  const Cell& cell = GetParam();
  core::PerAxis<bool> still_driven;
  const auto run = run_over(cell.wire, &cell, &still_driven);
  const auto& sound = sound_run_over(cell.wire);
  ASSERT_TRUE(sound.outcome.complete) << sound.outcome.reason;
  const auto* latched = run->first_fault();
  if (cell.latched == Latched::kNothing) {
    EXPECT_TRUE(run->outcome.complete) << run->outcome.reason;
    EXPECT_EQ(latched, nullptr);
    EXPECT_EQ(first_difference_ns(*run, sound), -1);
    EXPECT_EQ(run->log.size(), sound.log.size());
    return;
  }
  // The controller: the fault has the documented number, comes in time, and no axis is driven.
  ASSERT_NE(latched, nullptr);
  EXPECT_THAT(numbers_of(cell.latched), testing::Contains(latched->code));
  EXPECT_GE(latched->time_ns, kStruck_ns - 2 * core::kNanosecondsPerMillisecond);
  EXPECT_LE(latched->time_ns, kStruck_ns + 25 * core::kNanosecondsPerMillisecond);
  for (const auto axis : core::kPlanarAxes) {
    EXPECT_FALSE(still_driven[axis]) << core::name_of(axis);
  }
  // The plant: the drive is off, whether it was told so or found itself alone.
  EXPECT_NE(find(*run, PlantEventKind::kDriveRemoved), nullptr);
  if (!run->outcome.complete) {
    const auto* lost = find(*run, PlantEventKind::kPeerLost);
    ASSERT_NE(lost, nullptr);
    EXPECT_THAT(lost->code,
                AnyOf(ErrorCode::kPeerClosed, ErrorCode::kPeerSilent, ErrorCode::kTransportFailed));
  } else {
    EXPECT_NE(find(*run, PlantEventKind::kFinished), nullptr);
  }
}

std::vector<Cell> cells() {
  using enum WireKind;
  using enum WireTarget;
  using enum Latched;
  std::vector<Cell> all;
  for (const auto wire : {WireName::kSocket, WireName::kLine, WireName::kBus, WireName::kFdBus}) {
    const auto add = [&](bool to_plant, WireKind kind, WireTarget target, Latched latched,
                         std::size_t bit = 0) {
      all.push_back({wire, to_plant, {.kind = kind, .target = target, .bit = bit}, latched});
    };
    for (const bool to_plant : {true, false}) {
      // A digest without the one before it is none: its axis is not heard until the next whole one.
      const bool is_digest = wire == WireName::kBus && !to_plant;
      add(to_plant, kLoss, kData, is_digest ? kLost : kCorrupt);
      add(to_plant, kLoss, kTurn, kLost);
      // Edges take several FD frames; their first one sent twice begins the message anew.
      const bool is_segment = wire == WireName::kFdBus && !to_plant;
      add(to_plant, kDuplicate, kData, is_digest ? kLost : is_segment ? kNothing : kCorrupt);
      add(to_plant, kDuplicate, kTurn, kLost);
      add(to_plant, kFlood, kData, kNothing);
      add(to_plant, kJitter, kData, kNothing);
      add(to_plant, kDelay, kData, kLost);
      add(to_plant, kBabble, kData, kLost);
      if (wire == WireName::kBus || wire == WireName::kFdBus) {
        add(to_plant, kBusOff, kData, kLost);
        continue;  // a bus does not reorder, and repeats what it damages
      }
      add(to_plant, kReorder, kData, kCorrupt);
      for (const std::size_t bit : {1U, 20U, 60U, 99U}) {
        add(to_plant, kCorruption, kData, kEither, bit);
        add(to_plant, kCorruption, kTurn, kEither, bit);
      }
    }
    add(false, kDisconnect, kData, kLost);
  }
  return all;
}

INSTANTIATE_TEST_SUITE_P(Matrix, WireFaults, testing::ValuesIn(cells()), [](const auto& each) {
  const Cell& cell = each.param;
  const bool strikes_a_frame = cell.fault.kind <= WireKind::kCorruption;
  return fmt::format(
      "{}{}{}_over_a_{}_{}", name_of(cell.fault.kind),
      !strikes_a_frame                         ? ""
      : cell.fault.target == WireTarget::kTurn ? "_of_a_turns_end"
                                               : "_of_data",
      cell.fault.kind == WireKind::kCorruption ? fmt::format("_bit_{}", cell.fault.bit) : "",
      name_of(cell.wire), cell.to_plant ? "to_plant" : "to_controller");
});

// ---- what a carrier cannot have ----

TEST(WhatACarrierCannotHave, IsRefusedInALine) {
  using enum FaultKind;
  for (const auto bus : {CarrierKind::kCan, CarrierKind::kCanFd}) {
    for (const auto kind : {kReorder, kCorruptByte, kBaudMismatch}) {
      EXPECT_FALSE(why_not_over(bus, kind).empty()) << static_cast<int>(kind);
    }
    EXPECT_TRUE(why_not_over(bus, kBusOff).empty());
    EXPECT_TRUE(why_not_over(bus, kDuplicate).empty());
  }
  for (const auto stream : {CarrierKind::kLocal, CarrierKind::kSerial}) {
    EXPECT_FALSE(why_not_over(stream, kBusOff).empty());
    EXPECT_TRUE(why_not_over(stream, kReorder).empty());
  }
}

// ---- without a fault ----

TEST(SoundWires, OfEdgesGiveTheSameBits) {
  const auto& socket = sound_run_over(WireName::kSocket);
  for (const auto wire : {WireName::kLine, WireName::kFdBus}) {
    const auto& run = sound_run_over(wire);
    EXPECT_EQ(first_difference_ns(run, socket), -1) << name_of(wire);
    EXPECT_EQ(run.log.size(), socket.log.size());
    EXPECT_GT(run.truth.back().axes[Axis::kY].edges_total, 10'000);
  }
}

// ---- a greeting that is refused ----

class RefusedGreeting : public testing::TestWithParam<WireName> {
 protected:
  // What start() says; the plant has then moved nothing and removed its drive.
  ErrorCode refusal_of(std::uint64_t hash_differs, TwoSides::OtherVersion other_version) {
    CaseRecord record;
    TwoSides sides(GetParam(), fixture_.rig.parameters, record, other_version);
    LockstepBench bench(fixture_.controller.configuration, fixture_.rig.hash ^ hash_differs, sides,
                        &record);
    const auto agreed = bench.start();
    sides.controller_leaves();
    EXPECT_TRUE(record.truth.empty());
    EXPECT_NE(find(record, PlantEventKind::kPeerLost), nullptr);
    EXPECT_NE(find(record, PlantEventKind::kDriveRemoved), nullptr);
    return agreed ? ErrorCode::kNone : agreed.error();
  }
  ExperimentFixture fixture_ = Runs::shipped("wall-clock-window");
};

TEST_P(RefusedGreeting, OfAnotherFixtureMovesNothing) {
  EXPECT_EQ(refusal_of(1, TwoSides::OtherVersion::kNobody), ErrorCode::kProtocolFixtureMismatch);
}

TEST_P(RefusedGreeting, OfAControllerOfAnotherVersionMovesNothing) {
  EXPECT_EQ(refusal_of(0, TwoSides::OtherVersion::kController), ErrorCode::kProtocolVersion);
}

TEST_P(RefusedGreeting, OfAPlantOfAnotherVersionMovesNothing) {
  EXPECT_EQ(refusal_of(0, TwoSides::OtherVersion::kPlant), ErrorCode::kProtocolVersion);
}

INSTANTIATE_TEST_SUITE_P(Wires, RefusedGreeting,
                         testing::Values(WireName::kSocket, WireName::kLine, WireName::kBus,
                                         WireName::kFdBus),
                         [](const auto& each) { return std::string(name_of(each.param)); });

}  // namespace
}  // namespace towbench::harness

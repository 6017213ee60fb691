// What a link does to messages, over each carrier that needs no bus: the safe state is the same
// everywhere. Over CAN the same faults run in the test machine (fixtures/campaigns/can.toml).
#include <optional>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "bbmc/host/controller_node.h"
#include "harness/bench/linked_plant.h"
#include "harness/bench/lockstep_bench.h"
#include "harness/bench/plant_service.h"
#include "harness/bench/pty_line.h"
#include "harness/bench/unrecorded_plant.h"
#include "harness/faults/fault_text.h"
#include "harness/faults/faulted_experiment.h"
#include "protocol/carriers/connection.h"
#include "protocol/carriers/local_socket.h"
#include "tests/harness/end_to_end/run_support.h"

namespace towbench::harness {
namespace {

using core::ErrorCode;
using ::testing::HasSubstr;

struct LinkCase {
  const char* words;
  Carrier carrier;
  unsigned latched;
};

class LinkFaultOverACarrier : public testing::TestWithParam<LinkCase> {};

TEST_P(LinkFaultOverACarrier, EndsInTheDocumentedState) {
  Runs runs;
  auto fixture = Runs::shipped("wall-clock-window");
  add_faults(fixture, {parse_fault(GetParam().words)});
  const auto run = runs.run(fixture, GetParam().carrier);
  EXPECT_EQ(check_named(run, "fault_fired")->verdict, Verdict::kPass) << complaints_of(run);
  EXPECT_EQ(check_named(run, "recorded_run_is_judged")->verdict, Verdict::kPass);
  ASSERT_TRUE(run.faults.has_value()) << run.reason;
  EXPECT_TRUE(run.faults->handled) << complaints_of(run);
  const auto events = contents_of(run.folder / "events.jsonl");
  EXPECT_THAT(events, HasSubstr("fault_latched"));
  EXPECT_THAT(events, HasSubstr("\"code\":" + std::to_string(GetParam().latched)));
}

std::vector<LinkCase> link_cases() {
  std::vector<LinkCase> cases;
  for (const auto carrier : {Carrier::kLocal, Carrier::kSerialPty}) {
    cases.push_back({"link.to_controller loss at=0.9s", carrier, 321});
    cases.push_back({"link.to_controller reorder at=0.9s", carrier, 321});
    cases.push_back({"link.to_controller corrupt_byte at=0.9s", carrier, 321});
    cases.push_back({"link.to_controller duplicate at=0.9s", carrier, 321});
    cases.push_back({"link.to_controller peer_killed at=0.9s", carrier, 320});
  }
  return cases;
}

INSTANTIATE_TEST_SUITE_P(Carriers, LinkFaultOverACarrier, testing::ValuesIn(link_cases()),
                         [](const auto& each) {
                           std::string name = each.param.words;
                           name = name.substr(name.find(' ') + 1);
                           name = name.substr(0, name.find(' '));
                           return name + (each.param.carrier == Carrier::kLocal ? "_over_a_socket"
                                                                                : "_over_a_line");
                         });

// Both ends of a carrier in one process, the plant in a thread of its own.
struct Ends {
  std::unique_ptr<protocol::Connection> controller;
  std::unique_ptr<protocol::Connection> plant;
};

class RefusedGreeting : public testing::TestWithParam<Carrier> {
 protected:
  void SetUp() override {
    if (GetParam() == Carrier::kLocal) {
      auto pair = protocol::LocalSocket::pair();
      ends_ = {protocol::Connection::over(std::move(pair->first)),
               protocol::Connection::over(std::move(pair->second))};
      return;
    }
    const protocol::CarrierAddress near{.scheme = protocol::Scheme::kSerial,
                                        .place = line_.near_end()};
    const protocol::CarrierAddress far{.scheme = protocol::Scheme::kSerial,
                                       .place = line_.far_end()};
    ends_.plant = std::move(*protocol::Connection::to_controller(far, [] { return true; }));
    plant_ = std::thread([this] { serve(); });
    ends_.controller = std::move(*protocol::Connection::to_plant(near));
  }
  void TearDown() override {
    ends_.controller.reset();
    if (plant_.joinable()) {
      plant_.join();
    }
    // The plant has no controller, and says why.
    EXPECT_FALSE(ended_.has_value());
    EXPECT_THAT(observer_.kinds, testing::Contains(emulator::PlantEventKind::kDriveRemoved));
  }
  void begin() {
    if (!plant_.joinable()) {
      plant_ = std::thread([this] { serve(); });
    }
  }
  void serve() {
    emulator::PlantNode plant(fixture_.rig.parameters, 1, {}, observer_);
    const auto hello = ends_.plant->await_hello([] { return true; });
    ASSERT_TRUE(hello.has_value());
    ended_ = serve_plant(plant, ends_.plant->link(), *hello);
  }

  struct KeepingObserver final : emulator::PlantObserver {
    void on_truth(const emulator::TruthRow& /*row*/) noexcept override {}
    void on_event(const emulator::PlantEvent& event) noexcept override {
      kinds.push_back(event.kind);
    }
    std::vector<emulator::PlantEventKind> kinds;
  };
  PtyLine line_;
  Ends ends_;
  std::thread plant_;
  KeepingObserver observer_;
  core::Status ended_;
  ExperimentFixture fixture_ = Runs::shipped("wall-clock-window");
};

TEST_P(RefusedGreeting, OfAnotherFixtureMovesNothing) {
  begin();
  LinkedPlant plant(ends_.controller->link());
  LockstepBench bench(fixture_.controller.configuration, fixture_.rig.hash ^ 1U, plant, nullptr);
  const auto agreed = bench.start();
  ASSERT_FALSE(agreed.has_value());
  EXPECT_EQ(agreed.error(), ErrorCode::kProtocolFixtureMismatch);
}

TEST_P(RefusedGreeting, OfAnotherVersionMovesNothing) {
  begin();
  struct ReplyWatch final : protocol::MessageSink {
    using MessageSink::on;
    void on(const protocol::HelloReply& reply) noexcept override { refusal = reply.refusal; }
    ErrorCode refusal = ErrorCode::kNone;
  } watch;
  ends_.controller->link().peer().on(
      protocol::Hello{.version = protocol::kProtocolVersion + 1, .axes_mask = 3});
  ASSERT_TRUE(ends_.controller->link().wait_for(protocol::Turn::kHelloReply, watch).has_value());
  EXPECT_EQ(watch.refusal, ErrorCode::kProtocolVersion);
}

INSTANTIATE_TEST_SUITE_P(Carriers, RefusedGreeting,
                         testing::Values(Carrier::kLocal, Carrier::kSerialPty),
                         [](const auto& each) {
                           return std::string(each.param == Carrier::kLocal ? "socket" : "line");
                         });

}  // namespace
}  // namespace towbench::harness

// The controller's end of the protocol, as a bench or a process meets it.
#include "bbmc/host/controller_node.h"

#include <array>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace towbench::bbmc {
namespace {

using core::ErrorCode;

class Plant final : public protocol::MessageSink {
 public:
  using MessageSink::on;
  void on(const protocol::Hello& hello) noexcept override { hellos.push_back(hello); }
  void on(const protocol::PwmDuty& duty) noexcept override { duties.push_back(duty); }
  void on(const protocol::DigitalOutputs& outputs) noexcept override { enables.push_back(outputs); }
  void on(const protocol::Bye& /*bye*/) noexcept override { ++byes; }

  std::vector<protocol::Hello> hellos;
  std::vector<protocol::PwmDuty> duties;
  std::vector<protocol::DigitalOutputs> enables;
  int byes = 0;
};

class ControllerNodeTest : public ::testing::Test {
 protected:
  ControllerNodeTest() { node_.connect(plant_); }

  protocol::HelloReply reply() {
    protocol::HelloReply reply;
    reply.plant.role = protocol::Role::kPlant;
    reply.plant.axes_mask = 3;
    return reply;
  }

  // One quiet exchange: both encoders stand still.
  void exchange() {
    const core::Nanoseconds until_ns = now_ns_ + node_.exchange_ns();
    for (core::Axis axis : core::kPlanarAxes) {
      protocol::EncoderEdges edges;
      edges.axis = axis;
      edges.start_ns = now_ns_;
      edges.end_ns = until_ns;
      edges.sequence = sequence_;
      node_.on(edges);
    }
    ++sequence_;
    now_ns_ = until_ns;
    node_.on(protocol::Advanced{now_ns_});
    node_.serve(now_ns_);
  }

  std::vector<ControllerEvent> events() {
    std::vector<ControllerEvent> found;
    ControllerEvent event;
    while (node_.next_event(event)) {
      found.push_back(event);
    }
    return found;
  }

  Plant plant_;
  ControllerNode node_{Configuration{}, 42};
  core::Nanoseconds now_ns_ = 0;
  std::uint32_t sequence_ = 0;
};

TEST_F(ControllerNodeTest, GreetsWithWhatItIs) {
  EXPECT_EQ(node_.handshake().error(), ErrorCode::kPeerSilent);
  node_.greet();
  ASSERT_EQ(plant_.hellos.size(), 1U);
  EXPECT_EQ(plant_.hellos[0].role, protocol::Role::kController);
  EXPECT_EQ(plant_.hellos[0].axes_mask, 3);
  EXPECT_EQ(plant_.hellos[0].exchange_ns, 1'000'000U);
  EXPECT_EQ(plant_.hellos[0].fixture_hash, 42U);
}

TEST_F(ControllerNodeTest, AgreesOnlyWithAPlantOfItsVersionThatHasItsAxes) {
  auto wrong = reply();
  wrong.refusal = ErrorCode::kProtocolFixtureMismatch;
  node_.on(wrong);
  EXPECT_EQ(node_.handshake().error(), ErrorCode::kProtocolFixtureMismatch);
  wrong = reply();
  wrong.plant.version = 99;
  node_.on(wrong);
  EXPECT_EQ(node_.handshake().error(), ErrorCode::kProtocolVersion);
  wrong = reply();
  wrong.plant.role = protocol::Role::kObserver;
  node_.on(wrong);
  EXPECT_EQ(node_.handshake().error(), ErrorCode::kProtocolRole);
  wrong = reply();
  wrong.plant.axes_mask = 1;
  node_.on(wrong);
  EXPECT_EQ(node_.handshake().error(), ErrorCode::kProtocolAxes);
  node_.on(reply());
  EXPECT_TRUE(node_.handshake());
}

TEST_F(ControllerNodeTest, TheExchangeIsTheControlPeriodButNeverLongerThanAMillisecond) {
  for (const auto& [rate_Hz, exchange_ns] : {std::pair{1.0, 1'000'000},
                                             {10.0, 1'000'000},
                                             {1000.0, 1'000'000},
                                             {2000.0, 500'000},
                                             {5000.0, 200'000},
                                             {400.0, 500'000}}) {
    EXPECT_EQ(exchange_period_ns(core::nanoseconds(1.0 / rate_Hz)), exchange_ns) << rate_Hz;
  }
}

TEST_F(ControllerNodeTest, ServesARowATickAndPutsNothingOutWhileIdle) {
  node_.on(reply());
  node_.serve(0);
  for (int k = 0; k < 20; ++k) {
    exchange();
  }
  TelemetryRow row;
  int rows = 0;
  while (node_.next_row(row)) {
    EXPECT_EQ(row.time_ns, rows * core::kNanosecondsPerMillisecond);
    ++rows;
  }
  EXPECT_EQ(rows, 21);
  EXPECT_EQ(node_.rows_lost(), 0U);
  for (const auto& duty : plant_.duties) {
    EXPECT_EQ(duty.channel_a_ticks + duty.channel_b_ticks, 0);
    EXPECT_FALSE(duty.enable);
  }
}

TEST_F(ControllerNodeTest, AMissingMessageIsALinkFault) {
  node_.serve(0);
  exchange();
  static_cast<void>(events());
  ++sequence_;
  exchange();
  const auto found = events();
  ASSERT_FALSE(found.empty());
  bool latched = false;
  for (const auto& event : found) {
    latched |= event.kind == ControllerEvent::Kind::kFaultLatched &&
               event.code == ErrorCode::kFaultLinkCorrupt;
  }
  EXPECT_TRUE(latched);
}

TEST_F(ControllerNodeTest, ALostPeerIsALatchedFaultAndAnEvent) {
  node_.serve(0);
  exchange();
  node_.peer_lost(ErrorCode::kPeerSilent);
  bool lost = false;
  bool latched = false;
  for (const auto& event : events()) {
    lost |= event.kind == ControllerEvent::Kind::kPeerLost;
    latched |= event.kind == ControllerEvent::Kind::kFaultLatched &&
               event.code == ErrorCode::kFaultLinkLost;
  }
  EXPECT_TRUE(lost);
  EXPECT_TRUE(latched);
}

TEST_F(ControllerNodeTest, SaysByeOnceWithEverythingOff) {
  node_.serve(0);
  exchange();
  node_.say_bye();
  node_.say_bye();
  EXPECT_EQ(plant_.byes, 1);
  EXPECT_FALSE(plant_.duties.back().enable);
  ASSERT_FALSE(plant_.enables.empty());
  EXPECT_EQ(plant_.enables.back().lines, 0);
}

TEST_F(ControllerNodeTest, TheConsoleAnswers) {
  node_.serve(0);
  EXPECT_EQ(node_.type("status\r"), 7U);
  std::string text;
  for (int k = 0; k < 50; ++k) {
    exchange();
    std::array<char, 256> bytes{};
    const std::size_t count = node_.read_console(bytes);
    text.append(bytes.data(), count);
  }
  EXPECT_NE(text.find("ok"), std::string::npos) << text;
  EXPECT_TRUE(node_.idle());
}

}  // namespace
}  // namespace towbench::bbmc

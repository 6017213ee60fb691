#include <gtest/gtest.h>

#include "tests/emulator/recording_peer.h"

namespace towbench::emulator {
namespace {

using core::ErrorCode;

protocol::HelloReply reply_to(const protocol::Hello& hello, std::uint64_t fixture_hash = 0) {
  RigParameters rig = rig_starting_at(1.0, 0.3);
  rig.fixture_hash = fixture_hash;
  ScriptedController controller(rig);
  controller.greet(hello);
  return controller.peer.all<protocol::HelloReply>().at(0);
}

TEST(PlantNodeHandshake, AnswersWithWhatItIsAndThenTheLines) {
  ScriptedController controller(rig_starting_at(1.0, 0.3));
  controller.greet();
  EXPECT_EQ(controller.peer.order(), "HelloReply Inputs");
  const auto reply = controller.peer.all<protocol::HelloReply>().at(0);
  EXPECT_EQ(reply.refusal, ErrorCode::kNone);
  EXPECT_EQ(reply.plant.role, protocol::Role::kPlant);
  EXPECT_EQ(reply.plant.axes_mask, 3);
  EXPECT_EQ(reply.plant.tick_ns, 100'000U);
  EXPECT_EQ(reply.plant.exchange_ns, 1'000'000U);
  const auto inputs = controller.peer.all<protocol::DigitalInputs>().at(0);
  EXPECT_EQ(inputs.lines, mask_of(protocol::InputLine::kAmplifierReadyY) |
                              mask_of(protocol::InputLine::kAmplifierReadyX));
}

TEST(PlantNodeHandshake, RefusesWhatDoesNotFitAndStaysStill) {
  protocol::Hello wrong = ScriptedController::hello();
  wrong.version = 99;
  EXPECT_EQ(reply_to(wrong).refusal, ErrorCode::kProtocolVersion);
  wrong = ScriptedController::hello();
  wrong.role = protocol::Role::kPlant;
  EXPECT_EQ(reply_to(wrong).refusal, ErrorCode::kProtocolRole);
  wrong = ScriptedController::hello();
  wrong.axes_mask = 1;
  EXPECT_EQ(reply_to(wrong).refusal, ErrorCode::kProtocolAxes);
  wrong = ScriptedController::hello();
  wrong.tick_ns = 50'000;
  EXPECT_EQ(reply_to(wrong).refusal, ErrorCode::kProtocolTick);
  wrong = ScriptedController::hello();
  wrong.exchange_ns = 150'000;
  EXPECT_EQ(reply_to(wrong).refusal, ErrorCode::kProtocolTick);
  wrong = ScriptedController::hello();
  wrong.capabilities = 0;
  EXPECT_EQ(reply_to(wrong).refusal, ErrorCode::kProtocolCapabilities);
}

TEST(PlantNodeHandshake, ComparesFixturesOnlyWhenBothSidesKnowTheirs) {
  protocol::Hello hello = ScriptedController::hello();
  hello.fixture_hash = 7;
  EXPECT_EQ(reply_to(hello, 8).refusal, ErrorCode::kProtocolFixtureMismatch);
  EXPECT_EQ(reply_to(hello, 7).refusal, ErrorCode::kNone);
  EXPECT_EQ(reply_to(hello, 0).refusal, ErrorCode::kNone);
}

TEST(PlantNodeHandshake, RefusedOrUngreetedControllersMoveNothing) {
  for (const bool greet_wrongly : {false, true}) {
    ScriptedController controller(rig_starting_at(1.0, 0.3));
    if (greet_wrongly) {
      protocol::Hello wrong = ScriptedController::hello();
      wrong.axes_mask = 1;
      controller.greet(wrong);
    }
    controller.peer.forget();
    controller.enable();
    controller.drive(core::Axis::kY, 500);
    controller.advance_by(1'000'000);
    EXPECT_EQ(controller.peer.order(), "Fault Fault Fault");
    for (const auto& fault : controller.peer.all<protocol::Fault>()) {
      EXPECT_EQ(fault.code, ErrorCode::kProtocolNoHello);
    }
    EXPECT_EQ(controller.plant.now_ns(), 0);
  }
}

TEST(PlantNodeHandshake, ASecondHelloIsANewControllerWithoutDrive) {
  ScriptedController controller(rig_starting_at(1.0, 0.3));
  controller.greet();
  controller.enable();
  controller.drive(core::Axis::kY, 500);
  controller.run_for(50'000'000);
  const double moving = controller.peer.truth.back().axes[core::Axis::kY].motor_torque_Nm;
  EXPECT_GT(moving, 0.01);
  controller.greet();
  controller.run_for(5'000'000);
  EXPECT_EQ(controller.peer.all(PlantEventKind::kDriveRemoved).size(), 1U);
  EXPECT_EQ(controller.peer.truth.back().axes[core::Axis::kY].current_A, 0.0);
}

TEST(PlantNodeHandshake, ServesAMachineWithOneAxis) {
  RigParameters rig = rig_starting_at(1.0, 0.3);
  rig.axes[core::Axis::kX].exists = false;
  ScriptedController controller(rig);
  protocol::Hello hello = ScriptedController::hello();
  hello.axes_mask = 1;
  controller.greet(hello);
  controller.advance_by(1'000'000);
  EXPECT_EQ(controller.peer.order(), "HelloReply Inputs EdgesY Advanced");
  controller.peer.forget();
  controller.drive(core::Axis::kX, 100);
  EXPECT_EQ(controller.peer.all<protocol::Fault>().at(0).code, ErrorCode::kMessageBadField);
}

}  // namespace
}  // namespace towbench::emulator

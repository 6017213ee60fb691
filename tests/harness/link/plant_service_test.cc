// A message that can be read and makes no sense is answered, not passed over in silence.
#include "harness/link/plant_service.h"

#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "harness/fixtures/rig_fixture.h"
#include "harness/link/unrecorded_plant.h"
#include "protocol/carriers/local_socket.h"
#include "protocol/carriers/lockstep_link.h"

namespace towbench::harness {
namespace {

class Faults final : public protocol::MessageSink {
 public:
  using MessageSink::on;
  void on(const protocol::Fault& fault) noexcept override { codes.push_back(fault.code); }
  std::vector<core::ErrorCode> codes;
};

TEST(PlantService, AFieldOutOfRangeIsAnsweredByAFault) {
  auto ends = protocol::LocalSocket::pair();
  ASSERT_TRUE(ends);
  SourceFiles sources;
  const auto rig = load_rig("fixtures/rigs/macs-nominal.toml", sources).parameters;
  UnrecordedPlant unrecorded;
  emulator::PlantNode plant(rig, 1, {}, unrecorded);
  const protocol::Hello hello{.role = protocol::Role::kController,
                              .axes_mask = 3,
                              .tick_ns = 100'000,
                              .exchange_ns = 1'000'000,
                              .capabilities = protocol::kCapabilityEdges};
  std::thread machine([&] {
    protocol::LockstepLink link(*ends->second);
    (void)serve_plant(plant, link, hello);
  });
  protocol::LockstepLink controller(*ends->first);
  Faults heard;
  EXPECT_TRUE(controller.wait_for(protocol::Turn::kHelloReply, heard));
  controller.peer().on(protocol::PwmDuty{.enable = true, .channel_a_ticks = 1, .period_ticks = 0});
  for (core::Nanoseconds until_ns : {1'000'000, 2'000'000, 3'000'000}) {
    controller.peer().on(protocol::Advance{until_ns});
    EXPECT_TRUE(controller.wait_for(protocol::Turn::kAdvanced, heard));
  }
  controller.peer().on(protocol::Bye{});
  machine.join();
  ASSERT_FALSE(heard.codes.empty());
  EXPECT_EQ(heard.codes.front(), core::ErrorCode::kMessageBadField);
}

}  // namespace
}  // namespace towbench::harness

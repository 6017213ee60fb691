#include "protocol/handshake.h"

#include <array>
#include <string>

#include <gtest/gtest.h>

namespace towbench::protocol {
namespace {

using core::ErrorCode;

const Hello kController{.role = Role::kController,
                        .axes_mask = 3,
                        .tick_ns = 100'000,
                        .exchange_ns = 1'000'000,
                        .capabilities = kCapabilityEdges,
                        .fixture_hash = 0xabc};

Hello plant() {
  Hello hello = kController;
  hello.role = Role::kPlant;
  return hello;
}

ErrorCode verdict(const Hello& a, const Hello& b) {
  const auto forward = compare(a, b);
  const auto backward = compare(b, a);
  const ErrorCode code = forward ? ErrorCode::kNone : forward.error();
  EXPECT_EQ(code, backward ? ErrorCode::kNone : backward.error()) << "both sides judge alike";
  return code;
}

std::string explained(ErrorCode code, const Hello& a, const Hello& b) {
  std::array<char, 200> text{};
  return std::string(explain(code, a, b, text));
}

TEST(Handshake, AcceptsSidesThatAgree) {
  EXPECT_EQ(verdict(kController, plant()), ErrorCode::kNone);
}

TEST(Handshake, AcceptsAnObserverBesideEitherRole) {
  Hello observer = plant();
  observer.role = Role::kObserver;
  EXPECT_EQ(verdict(kController, observer), ErrorCode::kNone);
  EXPECT_EQ(verdict(plant(), observer), ErrorCode::kNone);
}

TEST(Handshake, RefusesAnotherVersionBeforeAnythingElse) {
  Hello other = kController;
  other.version = 3;
  other.axes_mask = 0;
  EXPECT_EQ(verdict(kController, other), ErrorCode::kProtocolVersion);
  other.role = Role::kPlant;
  EXPECT_EQ(explained(ErrorCode::kProtocolVersion, kController, other),
            "protocol versions differ: controller 2, plant 3");
}

TEST(Handshake, RefusesTwoOfTheSameRole) {
  EXPECT_EQ(verdict(kController, kController), ErrorCode::kProtocolRole);
  EXPECT_EQ(verdict(plant(), plant()), ErrorCode::kProtocolRole);
}

TEST(Handshake, RefusesOtherAxes) {
  Hello other = plant();
  other.axes_mask = 1;
  EXPECT_EQ(verdict(kController, other), ErrorCode::kProtocolAxes);
  EXPECT_EQ(explained(ErrorCode::kProtocolAxes, kController, other),
            "axes differ: controller yx, plant y");
  Hello none = kController;
  none.axes_mask = 0;
  other.axes_mask = 0;
  EXPECT_EQ(verdict(none, other), ErrorCode::kProtocolAxes) << "agreeing on nothing is no run";
}

TEST(Handshake, RefusesTicksThatDoNotFit) {
  Hello other = plant();
  other.tick_ns = 50'000;
  EXPECT_EQ(verdict(kController, other), ErrorCode::kProtocolTick);
  EXPECT_EQ(explained(ErrorCode::kProtocolTick, kController, other),
            "ticks differ: controller 100000 ns, exchange 1000000 ns, plant 50000 ns, exchange "
            "1000000 ns");
  other = plant();
  other.exchange_ns = 200'000;
  EXPECT_EQ(verdict(kController, other), ErrorCode::kProtocolTick);
  Hello uneven = kController;
  uneven.exchange_ns = 150'000;
  other.exchange_ns = 0;
  EXPECT_EQ(verdict(uneven, other), ErrorCode::kProtocolTick) << "not a whole number of ticks";
  uneven.exchange_ns = 0;
  EXPECT_EQ(verdict(uneven, other), ErrorCode::kProtocolTick) << "nobody says how far to go";
}

TEST(Handshake, LetsThePlantLeaveTheExchangeTimeToTheController) {
  Hello other = plant();
  other.exchange_ns = 0;
  EXPECT_EQ(verdict(kController, other), ErrorCode::kNone);
}

TEST(Handshake, RefusesSidesWithoutACommonFormOfEncoderData) {
  Hello other = plant();
  other.capabilities = kCapabilityDigest | 0x80000000U;
  EXPECT_EQ(verdict(kController, other), ErrorCode::kProtocolCapabilities);
  EXPECT_EQ(explained(ErrorCode::kProtocolCapabilities, kController, other),
            "no common way to send encoder data: controller edges, plant digest");
}

TEST(Handshake, RefusesAnotherFixtureUnlessOneSideKnowsNone) {
  Hello other = plant();
  other.fixture_hash = 0xdef;
  EXPECT_EQ(verdict(kController, other), ErrorCode::kProtocolFixtureMismatch);
  EXPECT_EQ(explained(ErrorCode::kProtocolFixtureMismatch, kController, other),
            "fixtures differ: controller abc, plant def");
  other.fixture_hash = 0;
  EXPECT_EQ(verdict(kController, other), ErrorCode::kNone);
}

TEST(Handshake, ExplainsWithinTheRoomItHas) {
  std::array<char, 12> text{};
  EXPECT_EQ(explain(ErrorCode::kProtocolRole, kController, kController, text), "both sides h");
  EXPECT_EQ(explain(ErrorCode::kProtocolRole, kController, kController, {}), "");
}

}  // namespace
}  // namespace towbench::protocol

#include "protocol/carriers/load.h"

#include <gtest/gtest.h>

#include "protocol/carriers/can_frame.h"
#include "protocol/cobs.h"
#include "tests/protocol/byte_sinks.h"

namespace towbench::protocol {
namespace {

// By hand from the byte tables. Duty 13 + 4 checksum + 2 = 19 bytes, report 39 -> 45, lines 15
// -> 21.
TEST(SerialLoad, CountsTheDigestOfTwoAxesAtOneKilohertz) {
  const Load load = serial_load({}, 921'600);
  EXPECT_DOUBLE_EQ(load.to_plant_bit_per_s, 2 * 19 * 10 * 1000.0 + 21 * 10 * 200.0);
  EXPECT_DOUBLE_EQ(load.to_controller_bit_per_s, 2 * 45 * 10 * 1000.0 + 21 * 10 * 200.0);
  EXPECT_DOUBLE_EQ(load.fraction(), 942'000.0 / 921'600.0);
}

TEST(SerialLoad, NeedsMoreThanTwentyMegabaudForTheEdgesAtTopSpeed) {
  const Load load = serial_load({.fidelity = Fidelity::kEdges}, 3'000'000);
  EXPECT_GT(load.to_controller_bit_per_s, 20e6);
  const auto refusal = accept_load(load, "/dev/ttyUSB0");
  ASSERT_FALSE(refusal.has_value());
  EXPECT_EQ(refusal.error().code, core::ErrorCode::kCarrierOverloaded);
  EXPECT_NE(refusal.error().message.find("/dev/ttyUSB0"), std::string::npos);
  EXPECT_NE(refusal.error().message.find(" % of 3000000 bit/s"), std::string::npos)
      << refusal.error().message;
}

TEST(SerialLoad, RefusesAboveEightyPercentAndNotBelow) {
  const double needed = serial_load({}, 1).to_controller_bit_per_s;
  const auto just_enough = static_cast<std::uint32_t>(needed / 0.8) + 1;
  EXPECT_TRUE(accept_load(serial_load({}, just_enough), "line").has_value());
  EXPECT_FALSE(accept_load(serial_load({}, just_enough - 2), "line").has_value());
  EXPECT_FALSE(accept_load(serial_load({}, 0), "line").has_value());
  EXPECT_FALSE(accept_load(serial_load({.axes = 0, .exchange_ns = 0}, 0), "line").has_value());
}

// The reckoning bounds what a writer really makes, whatever the contents.
TEST(SerialLoad, BoundsWhatIsReallyWritten) {
  for (const unsigned fill : {0U, 1U, 255U}) {
    KeepingByteSink out;
    CobsWriter writer(out, FlushAt::kRequest);
    const auto byte = static_cast<std::uint8_t>(fill);
    const auto word = static_cast<std::uint32_t>(byte * 0x01010101U);
    const auto time_ns = static_cast<core::Nanoseconds>(byte * 0x0001010101010101ULL);
    for (const core::Axis axis : core::kAxes) {
      writer.on(EncoderReport{.axis = axis, .time_ns = time_ns, .sequence = word});
      writer.on(CurrentSample{axis, time_ns, 1.0F});
    }
    writer.on(DigitalInputs{1, time_ns, word});
    writer.on(ForceSample{time_ns, {}, {}});
    writer.on(Advanced{time_ns});
    ASSERT_TRUE(writer.flush().has_value());
    const Traffic all{.lockstep = true,
                      .line_changes_per_s = 1000.0,
                      .force_samples = true,
                      .current_samples = true};
    const double bits = static_cast<double>(out.bytes.size() * 10);
    EXPECT_LE(bits * 1000.0, serial_load(all, 1).to_controller_bit_per_s);
  }
}

// 7,400 frames a second at 1 Mbit/s with the worst stuffing, as Davis et al. (2007) reckon it.
TEST(CanLoad, CountsTheWorstBitsOfAFrame) {
  EXPECT_EQ(worst_can_bits(8), 135U);
  EXPECT_EQ(worst_can_bits(0), 55U);
}

TEST(CanLoad, CarriesTheDigestOfTwoAxesAtOneKilohertz) {
  const Load load = can_load({}, 1'000'000);
  // 2 duties and 2 digests a millisecond, line changes, index pulses, whole reports of 7 frames.
  const double frames = 4000.0 + 400.0 + 2 * 70.9 + 2 * 1000.0 * 2.0 / 256.0 * 7.0;
  EXPECT_DOUBLE_EQ(load.fraction(), frames * 135.0 / 1e6);
  EXPECT_TRUE(accept_load(load, "can0").has_value());
  EXPECT_FALSE(accept_load(can_load({}, 500'000), "can0").has_value());
}

TEST(CanLoad, RefusesEdges) {
  const auto refusal = accept_load(can_load({.fidelity = Fidelity::kEdges}, 1'000'000), "can0");
  ASSERT_FALSE(refusal.has_value());
  EXPECT_NE(refusal.error().message.find("infinitely many"), std::string::npos);
}

}  // namespace
}  // namespace towbench::protocol

#include "protocol/carriers/load.h"

#include <gtest/gtest.h>

#include "protocol/carriers/can_frame.h"
#include "protocol/cobs.h"
#include "tests/protocol/byte_sinks.h"

namespace towbench::protocol {
namespace {

// By hand from the byte tables. Duty 13 + 4 checksum + 2 = 19 bytes, report 39 -> 45, lines to the
// plant 15 -> 21, to the controller 17 -> 23.
TEST(SerialLoad, CountsTheDigestOfTwoAxesAtOneKilohertz) {
  const Load load = serial_load({}, 921'600);
  EXPECT_DOUBLE_EQ(load.to_plant_bit_per_s, 2 * 19 * 10 * 1000.0 + 21 * 10 * 200.0);
  EXPECT_DOUBLE_EQ(load.to_controller_bit_per_s, 2 * 45 * 10 * 1000.0 + 23 * 10 * 200.0);
  EXPECT_DOUBLE_EQ(load.fraction(), 946'000.0 / 921'600.0);
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
    for (const core::Axis axis : core::kPlanarAxes) {
      writer.on(EncoderReport{.axis = axis, .time_ns = time_ns, .sequence = word});
      writer.on(CurrentSample{axis, time_ns, 1.0F});
      writer.on(Reference{axis, time_ns, 1.0F, 1.0F, 1.0F});
      writer.on(AbsoluteCount{axis, time_ns, static_cast<std::int32_t>(word), word});
    }
    writer.on(DigitalInputs{1, time_ns, word});
    writer.on(ForceSample{time_ns, {}, {}});
    writer.on(Advanced{time_ns});
    ASSERT_TRUE(writer.flush().has_value());
    const Traffic all{.lockstep = true,
                      .line_changes_per_s = 1000.0,
                      .force_samples = true,
                      .current_samples = true,
                      .references = true,
                      .absolute_counts = true};
    const double bits = static_cast<double>(out.bytes.size() * 10);
    EXPECT_LE(bits * 1000.0, serial_load(all, 1).to_controller_bit_per_s);
  }
}

// 18 bytes + 4 checksum + 2 on a line; on a bus 18 + 1 of length + 4 in segments of seven, so four.
TEST(SerialLoad, CountsTheAbsoluteCountOfEachAxis) {
  const double with = serial_load({.absolute_counts = true}, 1).to_controller_bit_per_s;
  EXPECT_DOUBLE_EQ(with - serial_load({}, 1).to_controller_bit_per_s, 2 * 24 * 10 * 1000.0);
}

TEST(CanLoad, CountsTheAbsoluteCountOfEachAxis) {
  const double with = can_load({.absolute_counts = true}, 1'000'000).to_controller_bit_per_s;
  const double without = can_load({}, 1'000'000).to_controller_bit_per_s;
  EXPECT_DOUBLE_EQ(with - without, 2 * 4 * 135 * 1000.0);
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

// By hand from ISO 11898-1:2015. Without data: 17 bits up to the switch of the rate, 4 stuffed, 13
// behind the checksum; 5 of length, 1 stuffed, 4 + 17 of count and checksum with 6 fixed stuff
// bits. With 64 bytes: 517 bits, 129 stuffed, 4 + 21, 7.
TEST(CanLoad, CountsTheWorstBitsOfAnFdFrameAtEachRate) {
  EXPECT_EQ(worst_can_fd_bits(0).nominal, 34U);
  EXPECT_EQ(worst_can_fd_bits(0).data, 5U + 1U + 21U + 6U);
  EXPECT_EQ(worst_can_fd_bits(64).nominal, 34U);
  EXPECT_EQ(worst_can_fd_bits(64).data, 517U + 129U + 25U + 7U);
}

// 284 edges of an axis in a millisecond at its voltage limit: 25 + 4 x 284 bytes, with length and
// checksum 1167 bytes, 18 frames of 63 and one of the 33 that are left: 34 -> 48.
TEST(CanLoad, RefusesTheEdgesAtTopSpeedOverFdWithBothFigures) {
  const Load load = can_load({.fidelity = Fidelity::kEdges}, 1'000'000, 5'000'000);
  const double last = 34.0 + (5.0 + 384.0 + 97.0 + 25.0 + 7.0) / 5.0;
  const double axis = 18.0 * (34.0 + 678.0 / 5.0) + last;
  EXPECT_NEAR(load.to_controller_bit_per_s, 2.0 * 1000.0 * axis + 200.0 * 135.0, 1e-3);
  const auto refusal = accept_load(load, "can:can0@1000000/5000000");
  ASSERT_FALSE(refusal.has_value());
  EXPECT_EQ(refusal.error().code, core::ErrorCode::kCarrierOverloaded);
  EXPECT_NE(refusal.error().message.find("% of 1000000 bit/s"), std::string::npos);
}

// A tenth of that speed fits: 29 edges, 25 + 4 x 29 + 6 bytes in three frames an axis.
TEST(CanLoad, CarriesTheEdgesOfASlowAxisOverFd) {
  const Traffic slow{.axes = 1, .fidelity = Fidelity::kEdges, .edges_per_s = 28'354.0};
  EXPECT_TRUE(accept_load(can_load(slow, 1'000'000, 5'000'000), "can0").has_value());
  EXPECT_FALSE(accept_load(can_load(slow, 1'000'000), "can0").has_value());
}

}  // namespace
}  // namespace towbench::protocol

// Records of a counter's character device, as linux/counter.h has them.
#include "bbmc/host/linux/index_events.h"

#include <array>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <linux/counter.h>
#include <unistd.h>

#include "bbmc/host/linux/linux_counter.h"
#include "tests/bbmc/support/fake_board.h"

namespace towbench::bbmc {
namespace {

using core::ErrorCode;

class IndexEventsTest : public ::testing::Test {
 protected:
  void SetUp() override { ASSERT_EQ(::pipe2(ends_.data(), O_NONBLOCK | O_CLOEXEC), 0); }
  void TearDown() override { close_device(); }

  void queue(std::uint64_t time_ns, std::uint64_t count, std::uint8_t status = 0) {
    counter_event record{};
    record.timestamp = time_ns;
    record.value = count;
    record.watch.event = COUNTER_EVENT_INDEX;
    record.status = status;
    ASSERT_EQ(::write(ends_[1], &record, sizeof record), static_cast<ssize_t>(sizeof record));
  }
  void close_device() {
    if (ends_[1] >= 0) {
      ::close(ends_[1]);
    }
    ends_[1] = -1;
  }

  std::array<int, 2> ends_{};
  DeviceTrouble trouble_;
};

TEST_F(IndexEventsTest, GivesEachEventOnceAndThenNone) {
  IndexEvents events;
  events.adopt(ends_[0], trouble_);
  queue(1'000, 77);
  queue(2'000, 4'077);
  IndexEvent event;
  ASSERT_TRUE(*events.next(event));
  EXPECT_EQ(event.count, 77U);
  ASSERT_TRUE(*events.next(event));
  EXPECT_EQ(event.time_ns, 2'000);
  EXPECT_EQ(event.count, 4'077U);
  EXPECT_FALSE(*events.next(event));
}

TEST_F(IndexEventsTest, AnEventThatTheDriverCouldNotFillIsAnError) {
  IndexEvents events;
  events.adopt(ends_[0], trouble_);
  queue(1'000, 0, EINVAL);
  IndexEvent event;
  EXPECT_EQ(events.next(event).error(), ErrorCode::kDeviceBadArgument);
}

TEST_F(IndexEventsTest, HalfARecordAndADeviceThatIsGoneAreErrors) {
  IndexEvents events;
  events.adopt(ends_[0], trouble_);
  ASSERT_EQ(::write(ends_[1], "half", 4), 4);
  IndexEvent event;
  EXPECT_EQ(events.next(event).error(), ErrorCode::kTransportFailed);
  close_device();
  EXPECT_EQ(events.next(event).error(), ErrorCode::kDeviceUnknown);
}

TEST_F(IndexEventsTest, AFileThatIsNoCounterIsRefused) {
  tests::FakeBoard fake;
  fake.write("/dev/counter0", "");
  IndexEvents events;
  EXPECT_EQ(events.open(fake.root().string() + "/dev/counter0", 0, trouble_).error(),
            ErrorCode::kDeviceUnsupported);
  ::close(ends_[0]);
}

TEST_F(IndexEventsTest, TheCounterLatchesTheCountOfThePulseNotOfTheSample) {
  tests::FakeBoard fake;
  LinuxCounter counter;
  ASSERT_TRUE(
      counter.open(fake.devices().axes[core::Axis::kY].encoder, fake.root().string(), trouble_));
  counter.index_events().adopt(ends_[0], trouble_);
  ASSERT_TRUE(counter.apply({}));
  ASSERT_TRUE(counter.sample(0));
  fake.write(tests::FakeBoard::count_file(core::Axis::kY), 4294967000U);  // 296 below 0
  queue(500'000, 4294967100U);
  ASSERT_TRUE(counter.sample(1'000'000));
  Eqep::Reading reading;
  ASSERT_TRUE(counter.read(reading));
  EXPECT_EQ(reading.index_pulses, 1U);
  EXPECT_EQ(reading.index_position, 4294967100U);
  EXPECT_EQ(reading.position, 4294967000U);
}

}  // namespace
}  // namespace towbench::bbmc

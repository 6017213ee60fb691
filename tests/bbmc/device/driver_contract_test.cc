// One contract, every driver: what the driver model promises (bbmc/device/driver.h) is tested once
// and applied to each device of each board: the emulated one, and kernel devices (OR-BBMC-2c).
#include <gtest/gtest.h>

#include "bbmc/device/device_manager.h"
#include "bbmc/host/emulated_board.h"
#include "bbmc/host/linux/linux_board.h"
#include "tests/bbmc/support/fake_board.h"

namespace towbench::bbmc {
namespace {

using core::ErrorCode;

// What each device considers right and wrong.
template <typename Device>
struct Sample;

template <>
struct Sample<Ehrpwm> {
  static EhrpwmDriver& driver(DeviceManager& devices) { return devices.pwm(core::Axis::kX); }
  static Ehrpwm::Settings good() { return {.period_ticks = 1000}; }
  static Ehrpwm::Settings other() { return {.period_ticks = 500}; }
  static Ehrpwm::Settings bad() { return {.period_ticks = 0}; }
  static Ehrpwm::Command command() { return {.channel_a_ticks = 20, .enable = true}; }
  static Ehrpwm::Command bad_command() { return {.channel_a_ticks = 1, .channel_b_ticks = 1}; }
};

template <>
struct Sample<Eqep> {
  static EqepDriver& driver(DeviceManager& devices) { return devices.encoder(core::Axis::kY); }
  static Eqep::Settings good() { return {}; }
  static Eqep::Settings other() { return {.position_max = 99'999}; }
  static Eqep::Settings bad() { return {.position_max = 3}; }
  static Eqep::Command command() { return {.position = 9'999}; }
  static Eqep::Command bad_command() { return {.position = 100'000}; }
};

template <>
struct Sample<Dmtimer> {
  static DmtimerDriver& driver(DeviceManager& devices) { return devices.control_timer(); }
  static Dmtimer::Settings good() { return {}; }
  static Dmtimer::Settings other() { return {.period_ns = core::kNanosecondsPerSecond}; }
  static Dmtimer::Settings bad() { return {.period_ns = 0}; }
  static Dmtimer::Command command() { return {Dmtimer::Action::kStart}; }
  static Dmtimer::Command bad_command() { return {static_cast<Dmtimer::Action>(9)}; }
};

template <>
struct Sample<Gpio> {
  static GpioDriver& driver(DeviceManager& devices) {
    return devices.line(Line::kAmplifierEnableX);
  }
  static Gpio::Settings good() { return {.output = true}; }
  static Gpio::Settings other() { return {.output = false}; }
  static Gpio::Settings bad() { return {.output = true, .interrupt_on_edges = true}; }
  static Gpio::Command command() { return {.active = true}; }
  // Every level is fine while the line is an output; tested as an input below.
  static Gpio::Command bad_command() { return {.active = true}; }
};

template <>
struct Sample<Uart> {
  static UartDriver& driver(DeviceManager& devices) { return devices.console(); }
  static Uart::Settings good() { return {}; }
  static Uart::Settings other() { return {.baud = 9'600}; }
  static Uart::Settings bad() { return {.baud = 0}; }
  static Uart::Command command() {
    Uart::Command chunk;
    EXPECT_TRUE(chunk.push_back('x'));
    return chunk;
  }
  static Uart::Command bad_command() { return {}; }
};

template <>
struct Sample<Aintc> {
  static AintcDriver& driver(DeviceManager& devices) { return devices.interrupts(); }
  static Aintc::Settings good() { return {}; }
  static Aintc::Settings other() { return {.threshold = 2}; }
  static Aintc::Settings bad() { return {.threshold = 0}; }
  static Aintc::Command command() { return {Line::kHallXMax, Aintc::Action::kMask}; }
  static Aintc::Command bad_command() { return {Line::kKillSwitch, Aintc::Action::kMask}; }
};

// The kernel's devices, in a folder that imitates them.
class KernelBoard {
 public:
  KernelBoard() { EXPECT_TRUE(board_.open(fake_.devices())) << board_.trouble().message(); }
  BoardPorts ports() noexcept { return board_.ports(); }

 private:
  tests::FakeBoard fake_;
  LinuxBoard board_;
};

template <typename TheDevice, typename TheBoard>
struct On {
  using Device = TheDevice;
  using Board = TheBoard;
};

template <typename Place>
class DriverContract : public ::testing::Test {
 protected:
  using Device = typename Place::Device;
  using Driver = towbench::bbmc::Driver<Device>;

  void make_ready() {
    ASSERT_TRUE(driver_.open());
    ASSERT_TRUE(driver_.init(Sample<Device>::good()));
  }

  typename Place::Board board_;
  DeviceManager devices_{board_.ports()};
  Driver& driver_ = Sample<Device>::driver(devices_);
};

using Places =
    ::testing::Types<On<Ehrpwm, EmulatedBoard>, On<Eqep, EmulatedBoard>, On<Dmtimer, EmulatedBoard>,
                     On<Gpio, EmulatedBoard>, On<Uart, EmulatedBoard>, On<Aintc, EmulatedBoard>,
                     On<Ehrpwm, KernelBoard>, On<Eqep, KernelBoard>, On<Dmtimer, KernelBoard>,
                     On<Gpio, KernelBoard>, On<Uart, KernelBoard>, On<Aintc, KernelBoard>>;
TYPED_TEST_SUITE(DriverContract, Places);

TYPED_TEST(DriverContract, StartsClosedAndRefusesEverythingButOpen) {
  typename TypeParam::Device::Reading reading{};
  EXPECT_EQ(this->driver_.state(), DriverState::kClosed);
  EXPECT_EQ(this->driver_.close().error(), ErrorCode::kDeviceNotOpen);
  EXPECT_EQ(this->driver_.init(Sample<typename TypeParam::Device>::good()).error(),
            ErrorCode::kDeviceNotOpen);
  EXPECT_EQ(this->driver_.config(Sample<typename TypeParam::Device>::good()).error(),
            ErrorCode::kDeviceNotOpen);
  EXPECT_EQ(this->driver_.read(reading).error(), ErrorCode::kDeviceNotOpen);
  EXPECT_EQ(this->driver_.write(Sample<typename TypeParam::Device>::command()).error(),
            ErrorCode::kDeviceNotOpen);
  EXPECT_EQ(this->driver_.state(), DriverState::kClosed);
}

TYPED_TEST(DriverContract, OpensOnce) {
  EXPECT_TRUE(this->driver_.open());
  EXPECT_EQ(this->driver_.state(), DriverState::kOpened);
  EXPECT_EQ(this->driver_.open().error(), ErrorCode::kDeviceAlreadyOpen);
}

TYPED_TEST(DriverContract, RefusesUseBeforeInit) {
  typename TypeParam::Device::Reading reading{};
  ASSERT_TRUE(this->driver_.open());
  EXPECT_EQ(this->driver_.config(Sample<typename TypeParam::Device>::good()).error(),
            ErrorCode::kDeviceNotInitialised);
  EXPECT_EQ(this->driver_.read(reading).error(), ErrorCode::kDeviceNotInitialised);
  EXPECT_EQ(this->driver_.write(Sample<typename TypeParam::Device>::command()).error(),
            ErrorCode::kDeviceNotInitialised);
}

TYPED_TEST(DriverContract, InitialisesOnceWithGoodSettingsOnly) {
  ASSERT_TRUE(this->driver_.open());
  EXPECT_EQ(this->driver_.init(Sample<typename TypeParam::Device>::bad()).error(),
            ErrorCode::kDeviceBadArgument);
  EXPECT_EQ(this->driver_.state(), DriverState::kOpened);
  EXPECT_TRUE(this->driver_.init(Sample<typename TypeParam::Device>::good()));
  EXPECT_EQ(this->driver_.state(), DriverState::kReady);
  EXPECT_EQ(this->driver_.init(Sample<typename TypeParam::Device>::good()).error(),
            ErrorCode::kDeviceBusy);
}

TYPED_TEST(DriverContract, IsReconfiguredWhileInUse) {
  this->make_ready();
  EXPECT_TRUE(this->driver_.config(Sample<typename TypeParam::Device>::other()));
  EXPECT_EQ(this->driver_.settings(), Sample<typename TypeParam::Device>::other());
}

TYPED_TEST(DriverContract, ARefusedConfigurationChangesNothing) {
  this->make_ready();
  EXPECT_EQ(this->driver_.config(Sample<typename TypeParam::Device>::bad()).error(),
            ErrorCode::kDeviceBadArgument);
  EXPECT_EQ(this->driver_.settings(), Sample<typename TypeParam::Device>::good());
  EXPECT_EQ(this->driver_.state(), DriverState::kReady);
}

TYPED_TEST(DriverContract, WritesWhatIsRightAndRefusesWhatIsNot) {
  this->make_ready();
  EXPECT_TRUE(this->driver_.write(Sample<typename TypeParam::Device>::command()));
  if constexpr (std::is_same_v<typename TypeParam::Device, Eqep> ||
                std::is_same_v<typename TypeParam::Device, Gpio>) {
    // Wrong only under other settings: a position beyond the counter, a level on an input.
    ASSERT_TRUE(this->driver_.config(Sample<typename TypeParam::Device>::other()));
  }
  EXPECT_EQ(this->driver_.write(Sample<typename TypeParam::Device>::bad_command()).error(),
            ErrorCode::kDeviceBadArgument);
}

TYPED_TEST(DriverContract, ClosesFromEveryOpenStateAndOpensAgain) {
  ASSERT_TRUE(this->driver_.open());
  EXPECT_TRUE(this->driver_.close());
  this->make_ready();
  EXPECT_TRUE(this->driver_.close());
  EXPECT_EQ(this->driver_.state(), DriverState::kClosed);
  EXPECT_EQ(this->driver_.write(Sample<typename TypeParam::Device>::command()).error(),
            ErrorCode::kDeviceNotOpen);
  this->make_ready();
}

// What is particular to a device.

TEST(EhrpwmDriver, PutsNothingOutAfterClose) {
  EmulatedBoard board;
  DeviceManager devices(board.ports());
  EhrpwmDriver& pwm = devices.pwm(core::Axis::kY);
  ASSERT_TRUE(pwm.open());
  ASSERT_TRUE(pwm.init({}));
  ASSERT_TRUE(pwm.write({.channel_b_ticks = 300, .enable = true}));
  ASSERT_TRUE(pwm.close());
  ASSERT_TRUE(pwm.open());
  ASSERT_TRUE(pwm.init({}));
  Ehrpwm::Reading output;
  ASSERT_TRUE(pwm.read(output));
  EXPECT_EQ(output, Ehrpwm::Reading{});
}

TEST(EqepDriver, RefusesACaptureClockThatTheBoardCannotMake) {
  EmulatedBoard board;
  DeviceManager devices(board.ports());
  EqepDriver& encoder = devices.encoder(core::Axis::kY);
  ASSERT_TRUE(encoder.open());
  EXPECT_EQ(encoder.init({.capture_clock_Hz = 3e6}).error(), ErrorCode::kDeviceUnsupported);
  EXPECT_EQ(encoder.state(), DriverState::kOpened);
}

TEST(DmtimerDriver, TicksAPeriodAfterTheTickThatWasDueNotAfterTheOneServed) {
  EmulatedBoard board;
  DeviceManager devices(board.ports());
  DmtimerDriver& timer = devices.control_timer();
  ASSERT_TRUE(timer.open());
  ASSERT_TRUE(timer.init({.period_ns = 1'000'000}));
  ASSERT_TRUE(timer.write({Dmtimer::Action::kStart}));
  board.set_time(1'300'000);  // served late
  ASSERT_TRUE(timer.write({Dmtimer::Action::kAcknowledge}));
  ASSERT_TRUE(timer.write({Dmtimer::Action::kAcknowledge}));
  Dmtimer::Reading reading;
  ASSERT_TRUE(timer.read(reading));
  EXPECT_EQ(reading.next_due_ns, 2'000'000);
  EXPECT_EQ(reading.ticks, 2U);
}

TEST(DeviceManager, ListsEveryUnitOnceAndClosesAll) {
  EmulatedBoard board;
  DeviceManager devices(board.ports());
  ASSERT_TRUE(devices.pwm(core::Axis::kX).open());
  ASSERT_TRUE(devices.line(Line::kHallXMin).open());
  std::size_t open = 0;
  for (std::size_t i = 0; i < DeviceManager::kUnitCount; ++i) {
    const DeviceUnit unit = devices.unit(i);
    EXPECT_FALSE(unit.device.empty());
    EXPECT_FALSE(unit.unit.empty());
    for (std::size_t k = 0; k < i; ++k) {
      EXPECT_FALSE(devices.unit(k).device == unit.device && devices.unit(k).unit == unit.unit);
    }
    open += unit.state == DriverState::kOpened ? 1U : 0U;
  }
  EXPECT_EQ(open, 2U);
  devices.close_all();
  for (std::size_t i = 0; i < DeviceManager::kUnitCount; ++i) {
    EXPECT_EQ(devices.unit(i).state, DriverState::kClosed);
  }
}

}  // namespace
}  // namespace towbench::bbmc

// One process of a controller, from its start to its end, against a bench that may misbehave.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "emulator/plant_node.h"
#include "harness/experiment/reference.h"
#include "harness/external/controller_process.h"
#include "harness/record/temporary_folder.h"
#include "protocol/carriers/connection.h"
#include "protocol/carriers/local_socket.h"
#include "protocol/each_message.h"

namespace towbench::harness {

class ConformSession {
 public:
  // Starts it: {address} in the command is where the bench waits. What it prints is appended to
  // `printed`. The rig outlives this. Throws std::system_error.
  ConformSession(const std::string& command, const emulator::RigParameters& rig,
                 const std::filesystem::path& printed);
  ~ConformSession();

  // Waits for its greeting and answers it, with a refusal where one is given. Empty, or why there
  // is no controller.
  [[nodiscard]] std::string greet(core::ErrorCode refusal = core::ErrorCode::kNone);
  // Runs turns until that time. False when the controller has left, or the bench's own
  // handshake refused it.
  [[nodiscard]] bool run_to(double time_s);
  // One turn. False as above.
  [[nodiscard]] bool turn();

  void press_kill_switch();
  // The next encoder message of the first axis is dropped.
  void lose_a_count() { to_controller_.loses_count = true; }
  // The counts of absolute encoders are dropped from now on.
  void lose_absolute_counts() { to_controller_.loses_absolute = true; }
  // Bytes that go out between two messages.
  void send_raw(std::span<const std::byte> bytes) { (void)socket_->write(bytes); }
  // Closes the connection without Bye.
  void hang_up() { connection_.reset(); }
  void say_bye();
  // How the process ended, in words, empty for code 0; none when it has not within two seconds.
  [[nodiscard]] std::optional<std::string> ended();

  [[nodiscard]] double now_s() const;
  // Any axis, by the last message of each.
  [[nodiscard]] bool drives() const noexcept;
  [[nodiscard]] bool has_driven() const noexcept { return to_plant_.has_driven; }
  // It sent Fault or Bye.
  [[nodiscard]] bool complained() const noexcept { return to_plant_.complained; }
  // Messages that came, greeting and heartbeats left out.
  [[nodiscard]] std::size_t heard() const noexcept { return to_plant_.heard; }
  // Turns that did not ask for one exchange more.
  [[nodiscard]] std::size_t odd_turns() const noexcept { return to_plant_.odd_turns; }
  // Messages that the plant refused, and what could not be read.
  [[nodiscard]] std::uint64_t refused() const;
  [[nodiscard]] bool wants_absolute_counts() const noexcept {
    return (hello_.capabilities & protocol::kCapabilityAbsolute) != 0;
  }
  // Why the bench refused it, or none.
  [[nodiscard]] core::ErrorCode refusal() const noexcept { return to_controller_.refusal; }

 private:
  struct Watch final : emulator::PlantObserver {
    void on_truth(const emulator::TruthRow& /*row*/) noexcept override {}
    void on_event(const emulator::PlantEvent& event) noexcept override;
    std::uint64_t refused = 0;
  };
  struct ToPlant final : protocol::EachMessage<ToPlant> {
    explicit ToPlant(ConformSession& owner) noexcept : session(owner) {}
    template <typename Message>
    void handle(const Message& message) noexcept {
      note(message);
      session.node_.on(message);
    }
    template <typename Message>
    void note(const Message& /*message*/) noexcept {
      ++heard;
    }
    void note(const protocol::Hello& /*hello*/) noexcept {}
    void note(const protocol::Heartbeat& /*heartbeat*/) noexcept {}
    void note(const protocol::PwmDuty& duty) noexcept;
    void note(const protocol::Advance& advance) noexcept;
    void note(const protocol::Fault& fault) noexcept;
    void note(const protocol::Bye& bye) noexcept;

    ConformSession& session;
    core::PerAxis<bool> driven{};
    bool has_driven = false;
    bool complained = false;
    std::size_t heard = 0;
    std::size_t odd_turns = 0;
  };
  struct ToController final : protocol::EachMessage<ToController> {
    explicit ToController(ConformSession& owner) noexcept : session(owner) {}
    template <typename Message>
    void handle(const Message& message) noexcept {
      session.connection_->link().peer().on(message);
    }
    void handle(const protocol::HelloReply& reply) noexcept;
    void handle(const protocol::EncoderReport& report) noexcept;
    void handle(const protocol::EncoderEdges& edges) noexcept;
    void handle(const protocol::AbsoluteCount& count) noexcept;
    void handle(const protocol::Advanced& advanced) noexcept;

    ConformSession& session;
    core::ErrorCode refusal = core::ErrorCode::kNone;
    bool loses_count = false;
    bool loses_absolute = false;
  };

  const emulator::RigParameters& rig_;
  TemporaryFolder folder_;  // that only this user may enter
  ReferenceSchedule reference_;
  Watch watch_;
  emulator::PlantNode node_;
  ToPlant to_plant_{*this};
  ToController to_controller_{*this};
  protocol::Hello hello_;
  std::unique_ptr<protocol::LocalServer> server_;
  protocol::LocalSocket* socket_ = nullptr;  // of connection_
  std::unique_ptr<protocol::Connection> connection_;
  std::optional<ControllerProcess> process_;
};

}  // namespace towbench::harness

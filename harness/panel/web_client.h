// One page's WebSocket. Frames are for looking at: a page that cannot keep up misses some, and the
// count of those goes with the next. Answers to its own commands wait for it; when too many do, or
// it sends too much, it is let go.
#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <string>

#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>

namespace towbench::harness {

class WebClient : public std::enable_shared_from_this<WebClient> {
 public:
  // Compression is never asked for, and to compile it takes an eighth of the panel's time.
  using Socket = boost::beast::websocket::stream<boost::beast::tcp_stream, false>;
  using Request = boost::beast::http::request<boost::beast::http::string_body>;
  // Takes a message, returns the refusal or nothing.
  using OnMessage = std::function<std::string(std::string_view)>;
  using OnEnd = std::function<void(WebClient*)>;
  // How things stand, for a page that has missed frames: the last of them may have been among
  // these.
  using OnCaughtUp = std::function<std::string()>;

  WebClient(boost::beast::tcp_stream stream, OnMessage on_message, OnCaughtUp on_caught_up,
            OnEnd on_end);

  // The first message is what `on_caught_up` gives.
  void open(const Request& request);
  // Shared by all pages; dropped when this one still has frames to swallow.
  void show(const std::shared_ptr<const std::string>& frame);
  void close();

 private:
  void read();
  void heard(boost::beast::error_code error);
  [[nodiscard]] bool too_fast();
  void queue(std::shared_ptr<const std::string> message);
  void write();
  void tell_missed();
  void end();

  // As WebServer's own bounds.
  static constexpr std::size_t kMostWaiting = 64;
  static constexpr std::size_t kMostFramesWaiting = 4;
  static constexpr std::size_t kLongestMessage = 64U << 10U;
  static constexpr std::uint32_t kMostMessagesPerSecond = 200;

  Socket socket_;
  OnMessage on_message_;
  OnCaughtUp on_caught_up_;
  OnEnd on_end_;
  boost::beast::flat_buffer buffer_;
  std::deque<std::shared_ptr<const std::string>> waiting_;
  std::uint64_t missed_ = 0;
  bool open_ = false;
  bool ended_ = false;
  std::chrono::steady_clock::time_point second_began_{};
  std::uint32_t messages_this_second_ = 0;
};

}  // namespace towbench::harness

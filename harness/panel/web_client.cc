#include "harness/panel/web_client.h"

#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace towbench::harness {
namespace beast = boost::beast;
namespace websocket = beast::websocket;

WebClient::WebClient(beast::tcp_stream stream, OnMessage on_message, OnCaughtUp on_caught_up,
                     OnEnd on_end)
    : socket_(std::move(stream)),
      on_message_(std::move(on_message)),
      on_caught_up_(std::move(on_caught_up)),
      on_end_(std::move(on_end)) {}

void WebClient::open(const Request& request) {
  // The socket has a patience of its own.
  beast::get_lowest_layer(socket_).expires_never();
  websocket::stream_base::timeout patience{};
  patience.handshake_timeout = std::chrono::seconds(5);
  patience.idle_timeout = std::chrono::seconds(30);  // pings; a closed laptop does not answer
  patience.keep_alive_pings = true;
  socket_.set_option(patience);
  socket_.read_message_max(kLongestMessage);
  socket_.async_accept(request, [self = shared_from_this()](beast::error_code error) {
    if (error) {
      self->end();
      return;
    }
    // The state of this moment: frames between request and acceptance were not sent to this client.
    self->open_ = true;
    self->queue(std::make_shared<const std::string>(self->on_caught_up_()));
    self->read();
  });
}

void WebClient::read() {
  socket_.async_read(buffer_, [self = shared_from_this()](beast::error_code error, std::size_t) {
    self->heard(error);
  });
}

bool WebClient::too_fast() {
  const auto now = std::chrono::steady_clock::now();
  if (now - second_began_ > std::chrono::seconds(1)) {
    second_began_ = now;
    messages_this_second_ = 0;
  }
  return ++messages_this_second_ > kMostMessagesPerSecond;
}

void WebClient::heard(beast::error_code error) {
  if (error || ended_ || too_fast()) {
    close();
    return;
  }
  const auto bytes = buffer_.data();
  const auto refusal =
      on_message_(std::string_view(static_cast<const char*>(bytes.data()), bytes.size()));
  buffer_.consume(buffer_.size());
  // Each message has an answer: who gets none knows that it may not have been heard.
  nlohmann::json told = {{"kind", refusal.empty() ? "heard" : "refused"}};
  if (!refusal.empty()) {
    told["why"] = refusal;
  }
  queue(std::make_shared<const std::string>(
      told.dump(-1, ' ', true, nlohmann::json::error_handler_t::replace)));
  if (!ended_) {
    read();
  }
}

void WebClient::show(const std::shared_ptr<const std::string>& frame) {
  if (!open_ || ended_) {
    return;
  }
  if (waiting_.size() >= kMostFramesWaiting) {
    ++missed_;
    return;
  }
  if (missed_ > 0) {
    tell_missed();
  }
  queue(frame);
}

void WebClient::tell_missed() {
  queue(std::make_shared<const std::string>(
      fmt::format(R"({{"kind":"missed","frames":{}}})", std::exchange(missed_, 0))));
}

void WebClient::queue(std::shared_ptr<const std::string> message) {
  if (waiting_.size() >= kMostWaiting) {
    close();
    return;
  }
  waiting_.push_back(std::move(message));
  if (waiting_.size() == 1) {
    write();
  }
}

void WebClient::write() {
  socket_.text(true);
  socket_.async_write(boost::asio::buffer(*waiting_.front()),
                      [self = shared_from_this()](beast::error_code error, std::size_t) {
                        if (error || self->ended_) {
                          self->close();
                          return;
                        }
                        self->waiting_.pop_front();
                        if (!self->waiting_.empty()) {
                          self->write();
                        } else if (self->missed_ > 0) {
                          self->tell_missed();
                          self->queue(std::make_shared<const std::string>(self->on_caught_up_()));
                        }
                      });
}

void WebClient::close() {
  // Not politely: who floods or sleeps would not hear it.
  beast::get_lowest_layer(socket_).close();
  end();
}

void WebClient::end() {
  if (!std::exchange(ended_, true)) {
    on_end_(this);
  }
}

}  // namespace towbench::harness

#include "harness/panel/web_server.h"

#include <algorithm>
#include <chrono>
#include <deque>
#include <memory>
#include <utility>
#include <vector>

#include <boost/asio/io_context.hpp>
#include <boost/asio/steady_timer.hpp>
#include <fcntl.h>
#include <fmt/format.h>

#include "harness/panel/frames.h"
#include "harness/panel/steering.h"
#include "harness/panel/turns.h"
#include "harness/panel/web_client.h"
#include "harness/panel/web_keys.h"
#include "harness/panel/web_routes.h"

namespace towbench::harness {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
using asio::ip::tcp;

constexpr std::size_t kMostConnections = 32;
constexpr std::size_t kMostPages = 8;
constexpr auto kPatience = std::chrono::seconds(10);
constexpr auto kFrameEvery = std::chrono::milliseconds(50);
constexpr std::uint32_t kLongestHead = 8U << 10U;

WebRequest request_of(const WebClient::Request& message) {
  const auto field = [&](http::field name) { return std::string(message[name]); };
  return {.method = std::string(message.method_string()),
          .target = std::string(message.target()),
          .host = field(http::field::host),
          .origin = field(http::field::origin),
          .cookie = field(http::field::cookie)};
}

// The machine's process of a run by the wall clock must not hold the panel's port or pages.
template <typename Socket>
void keep_from_children(Socket& socket) {
  (void)fcntl(socket.native_handle(), F_SETFD, FD_CLOEXEC);
}

template <typename Body>
void set_head(http::response<Body>& response, const WebAnswer& answer) {
  response.result(answer.status);
  response.set(http::field::content_type, answer.type);
  response.set(http::field::cache_control, "no-store");
  response.set("X-Content-Type-Options", "nosniff");
  response.set("Referrer-Policy", "no-referrer");
  response.set("X-Frame-Options", "SAMEORIGIN");
  // A run's report brings its own policy, which names its one script.
  if (!answer.file) {
    response.set("Content-Security-Policy",
                 "default-src 'none'; script-src 'self'; style-src 'self' 'unsafe-inline'; "
                 "connect-src 'self'; img-src 'self' data:; frame-src 'self'; base-uri 'none'; "
                 "form-action 'none'; frame-ancestors 'none'");
  }
  if (!answer.cookie.empty()) {
    response.set(http::field::set_cookie, answer.cookie);
  }
  if (!answer.location.empty()) {
    response.set(http::field::location, answer.location);
  }
  response.keep_alive(false);
}

}  // namespace

class WebServer::Implementation {
 public:
  Implementation(const WebOptions& options, Session& session)
      : session_(session),
        acceptor_(io_, tcp::endpoint(asio::ip::make_address(options.address), options.port)),
        timer_(io_),
        frames_(session),
        host_(name_of(acceptor_.local_endpoint())),
        routes_(session.runs(), names_of(acceptor_.local_endpoint()), keys_,
                session.controller() ? session.controller()->text() : "") {
    keep_from_children(acceptor_);
    accept();
  }

  [[nodiscard]] std::string address_with_ticket() const {
    return "http://" + host_ + "/?ticket=" + keys_.ticket();
  }
  void on_ticket_used(std::function<void(const std::string&)> told) { told_ = std::move(told); }

  void run(const std::atomic<bool>& stop) {
    stop_ = &stop;
    observe_only();
    tick();
    io_.run();
  }

 private:
  class Exchange;

  static std::string name_of(const tcp::endpoint& end) {
    const auto address = end.address();
    const auto text = address.is_v6() ? "[" + address.to_string() + "]" : address.to_string();
    return fmt::format("{}:{}", text, end.port());
  }
  static std::vector<std::string> names_of(const tcp::endpoint& end) {
    return {name_of(end), fmt::format("localhost:{}", end.port())};
  }

  void accept();
  void tick() {
    if (stop_->load(std::memory_order_relaxed)) {
      io_.stop();
      return;
    }
    if (auto frame = frames_.next(); !frame.empty()) {
      const auto shared = std::make_shared<const std::string>(std::move(frame));
      const auto pages = pages_;  // one that is let go leaves the list
      for (const auto& page : pages) {
        page->show(shared);
      }
    }
    timer_.expires_after(kFrameEvery);
    timer_.async_wait([this](beast::error_code) { tick(); });
  }

  void welcome(beast::tcp_stream stream, const WebClient::Request& request) {
    auto page = std::make_shared<WebClient>(
        std::move(stream), [this](std::string_view message) { return steer(session_, message); },
        [this] { return frames_.greeting(); },
        [this](WebClient* gone) {
          std::erase_if(pages_, [gone](const auto& one) { return one.get() == gone; });
        });
    pages_.push_back(page);
    page->open(request);
  }

  asio::io_context io_{1};
  Session& session_;
  tcp::acceptor acceptor_;
  asio::steady_timer timer_;
  FrameMaker frames_;
  WebKeys keys_;
  std::string host_;
  WebRoutes routes_;
  std::function<void(const std::string&)> told_;
  const std::atomic<bool>* stop_ = nullptr;
  std::size_t connections_ = 0;
  std::deque<std::weak_ptr<Exchange>> waiting_;  // the last ones, oldest first
  std::vector<std::shared_ptr<WebClient>> pages_;
};

// One request and its answer.
class WebServer::Implementation::Exchange : public std::enable_shared_from_this<Exchange> {
 public:
  Exchange(tcp::socket socket, Implementation& owner) : owner_(owner), stream_(std::move(socket)) {
    ++owner_.connections_;
  }
  Exchange(const Exchange&) = delete;
  Exchange& operator=(const Exchange&) = delete;
  ~Exchange() { --owner_.connections_; }

  // It has not said what it wants, and others wait.
  void give_up() {
    if (reading_) {
      stream_.close();
    }
  }

  void start() {
    parser_.header_limit(kLongestHead);
    parser_.body_limit(0);
    stream_.expires_after(kPatience);
    http::async_read(stream_, buffer_, parser_,
                     [self = shared_from_this()](beast::error_code error, std::size_t) {
                       self->reading_ = false;
                       if (!error) {
                         self->serve();
                       }
                     });
  }

 private:
  void serve() {
    const auto request = request_of(parser_.get());
    if (beast::websocket::is_upgrade(parser_.get())) {
      auto refused = owner_.routes_.refuse_socket(request);
      if (!refused && owner_.pages_.size() >= kMostPages) {
        refused = WebAnswer{.status = 503, .body = "too many pages are open\n"};
      }
      if (!refused) {
        owner_.welcome(std::move(stream_), parser_.get());
        return;
      }
      send(*refused);
      return;
    }
    const auto ticket = owner_.keys_.ticket();
    const auto answer = owner_.routes_.answer(request);
    if (ticket != owner_.keys_.ticket() && owner_.told_) {
      owner_.told_(owner_.address_with_ticket());
    }
    send(answer);
  }

  void send(const WebAnswer& answer) {
    if (answer.file) {
      beast::error_code error;
      http::file_body::value_type body;
      body.open(answer.file->c_str(), beast::file_mode::scan, error);
      if (error) {
        send({.status = 404, .body = "no such file\n"});
        return;
      }
      auto response = std::make_shared<http::response<http::file_body>>();
      response->body() = std::move(body);
      set_head(*response, answer);
      response->prepare_payload();
      write(response);
      return;
    }
    auto response = std::make_shared<http::response<http::string_body>>();
    response->body() = answer.body;
    set_head(*response, answer);
    response->prepare_payload();
    write(response);
  }

  template <typename Response>
  void write(const std::shared_ptr<Response>& response) {
    stream_.expires_after(kPatience);
    http::async_write(stream_, *response,
                      [self = shared_from_this(), response](beast::error_code, std::size_t) {
                        beast::error_code ignored;
                        self->stream_.socket().shutdown(tcp::socket::shutdown_send, ignored);
                      });
  }

  Implementation& owner_;
  bool reading_ = true;
  beast::tcp_stream stream_;
  beast::flat_buffer buffer_;
  http::request_parser<http::string_body> parser_;
};

void WebServer::Implementation::accept() {
  acceptor_.async_accept([this](beast::error_code error, tcp::socket socket) {
    // One too many makes the oldest give up that has not said what it wants.
    if (!error) {
      if (waiting_.size() >= kMostConnections) {
        if (const auto oldest = waiting_.front().lock()) {
          oldest->give_up();
        }
        waiting_.pop_front();
      }
      if (connections_ < 2 * kMostConnections) {
        keep_from_children(socket);
        const auto exchange = std::make_shared<Exchange>(std::move(socket), *this);
        waiting_.push_back(exchange);
        exchange->start();
      }
    }
    accept();
  });
}

WebServer::WebServer(const WebOptions& options, Session& session)
    : implementation_(std::make_unique<Implementation>(options, session)) {}
WebServer::~WebServer() = default;

std::string WebServer::address_with_ticket() const {
  return implementation_->address_with_ticket();
}
void WebServer::on_ticket_used(std::function<void(const std::string&)> told) {
  implementation_->on_ticket_used(std::move(told));
}
void WebServer::run(const std::atomic<bool>& stop) {
  implementation_->run(stop);
}

}  // namespace towbench::harness

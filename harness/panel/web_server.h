// HTTP and WebSocket on this machine: one thread, in which run() is called. Every connection is
// bounded in number, size, rate and patience; whoever exceeds a bound is let go, and nobody else
// notices.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "harness/panel/session.h"

namespace towbench::harness {

struct WebOptions {
  std::string address = "127.0.0.1";
  std::uint16_t port = 0;  // 0: any that is free
};

class WebServer {
 public:
  // Listens from here on. Throws system_error when the address is taken or is no address.
  WebServer(const WebOptions& options, Session& session);
  WebServer(const WebServer&) = delete;
  WebServer& operator=(const WebServer&) = delete;
  ~WebServer();

  // Where a browser is let in next; another one after each use.
  [[nodiscard]] std::string address_with_ticket() const;
  // Called with the new address when one has been used.
  void on_ticket_used(std::function<void(const std::string&)> told);

  // Until `stop` is true (looked at twenty times a second).
  void run(const std::atomic<bool>& stop);

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace towbench::harness

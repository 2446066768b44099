// The module dmpc_http.so: web pages by cpp-httplib (MIT), which Debian has as a shared library that brings OpenSSL and Brotli;
// none of that is loaded by who serves nothing.

#include <fcntl.h>
#include <httplib.h>
#include <poll.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "apps/frontend/system/module.h"
#include "apps/frontend/web/web_server.h"

namespace dmpc::apps {
namespace {

using Clock = std::chrono::steady_clock;

// As apps/frontend/web/web_server.h has them.
constexpr std::chrono::seconds request_timeout{2}, deaf_timeout{1}, end_timeout{2};
constexpr std::size_t request_bytes_max = std::size_t{32} << 10U, bytes_a_second_least = std::size_t{16} << 10U;
/// Limit of a request's body.
constexpr std::size_t payload_bytes_max = 4096;
/// Limit of the path of requests with a body: our paths are short.
constexpr std::size_t path_bytes_max = 256;
/// Longer ones are sent in parts, between which a stream may end.
constexpr std::size_t part_bytes = std::size_t{16} << 10U;

/// Set for a connection that would have to wait behind too many others.
thread_local bool is_one_too_many = false;

/// Threads that answer, all started at once, so that a lack of threads is reported before anything is served.
class Crew final : public httplib::TaskQueue {
 public:
  explicit Crew(std::size_t count) : waiting_max_(count) {
    try {
      for (std::size_t i = 0; i < count; ++i) {
        threads_.emplace_back([this] { work(); });
      }
    } catch (...) {
      shutdown();
      throw;
    }
  }

  void enqueue(std::function<void()> job) override {
    std::unique_lock lock(mutex_);
    if (jobs_.size() < waiting_max_) {
      jobs_.push_back(std::move(job));
      lock.unlock();
      there_is_one_.notify_one();
    } else {
      lock.unlock();
      is_one_too_many = true;
      job();
      is_one_too_many = false;
    }
  }
  void shutdown() override {
    {
      const std::lock_guard lock(mutex_);
      is_over_ = true;
    }
    there_is_one_.notify_all();
    threads_.clear();  // when all is done
  }

 private:
  void work() {
    for (;;) {
      std::unique_lock lock(mutex_);
      there_is_one_.wait(lock, [this] { return is_over_ || !jobs_.empty(); });
      if (jobs_.empty()) {
        return;
      }
      const std::function<void()> job = std::move(jobs_.front());
      jobs_.pop_front();
      lock.unlock();
      job();
    }
  }

  const std::size_t waiting_max_;
  std::mutex mutex_;
  std::condition_variable there_is_one_;
  std::deque<std::function<void()>> jobs_;
  bool is_over_ = false;
  std::vector<std::jthread> threads_;
};

/// When a server ends.
class End {
 public:
  void come() { at_.store((Clock::now() + end_timeout).time_since_epoch().count(), std::memory_order_relaxed); }
  bool has_come() const { return at_.load(std::memory_order_relaxed) != never; }
  /// What nobody waits beyond.
  Clock::time_point last() const { return Clock::time_point(Clock::duration(at_.load(std::memory_order_relaxed))); }

 private:
  static constexpr Clock::rep never = Clock::time_point::max().time_since_epoch().count();
  std::atomic<Clock::rep> at_ = never;
};

/// A connection whose patience and length have an end: httplib's own begins anew with each byte.
class Connection final : public httplib::Stream {
 public:
  Connection(int socket, const End& end) : socket_(socket), end_(end) {}
  ~Connection() override {
    ::shutdown(socket_, SHUT_RDWR);
    ::close(socket_);
  }
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  bool is_readable() const override { return next_ < filled_ || wait_for(POLLIN, Clock::now()); }
  bool is_writable() const override { return wait_for(POLLOUT, Clock::now()); }

  ssize_t read(char* to, std::size_t size) override {
    if (next_ == filled_ && !fill()) {
      return -1;
    }
    const std::size_t count = std::min(size, filled_ - next_);
    std::copy_n(buffer_.begin() + static_cast<std::ptrdiff_t>(next_), count, to);
    next_ += count;
    return static_cast<ssize_t>(count);
  }

  ssize_t write(const char* from, std::size_t size) override {
    const Clock::time_point begin = Clock::now();
    const bool is_ready = wait_for(POLLOUT, begin + deaf_timeout);
    waited_ += Clock::now() - begin;
    if (!is_ready || waited_ > deaf_timeout + std::chrono::seconds(sent_bytes_ / bytes_a_second_least)) {
      return -1;
    }
    const ssize_t sent = ::send(socket_, from, size, MSG_NOSIGNAL | MSG_DONTWAIT);
    sent_bytes_ += static_cast<std::size_t>(std::max<ssize_t>(sent, 0));
    return sent;
  }

  void get_remote_ip_and_port(std::string& /*ip*/, int& /*port*/) const override {}  // everybody is here
  void get_local_ip_and_port(std::string& /*ip*/, int& /*port*/) const override {}
  socket_t socket() const override { return socket_; }

 private:
  bool fill() {
    if (read_bytes_ >= request_bytes_max || !wait_for(POLLIN, begin_ + request_timeout)) {
      return false;
    }
    const ssize_t count = ::recv(socket_, buffer_.data(), buffer_.size(), MSG_DONTWAIT);
    filled_ = static_cast<std::size_t>(std::max<ssize_t>(count, 0));
    next_ = 0;
    read_bytes_ += filled_;
    return filled_ > 0;
  }

  bool wait_for(short what, Clock::time_point until) const {
    pollfd polled{.fd = socket_, .events = what, .revents = 0};
    for (;;) {
      const auto left = std::chrono::ceil<std::chrono::milliseconds>(std::min(until, end_.last()) - Clock::now());
      const int count = ::poll(&polled, 1, static_cast<int>(std::max<std::int64_t>(0, left.count())));
      if (count >= 0 || errno != EINTR) {
        return count > 0;
      }
    }
  }

  const int socket_;
  const End& end_;
  const Clock::time_point begin_ = Clock::now();
  std::array<char, 4096> buffer_{};
  std::size_t next_ = 0, filled_ = 0, read_bytes_ = 0, sent_bytes_ = 0;
  Clock::duration waited_{};  ///< to send
};

class SinkStream final : public WebStream {
 public:
  SinkStream(httplib::DataSink& sink, const End& end) : sink_(sink), end_(end) {}

  bool send(std::string_view bytes) override {
    while (!bytes.empty() && !end_.has_come()) {
      const std::string_view part = bytes.substr(0, part_bytes);
      if (!sink_.write(part.data(), part.size())) {
        return false;
      }
      bytes.remove_prefix(part.size());
    }
    return bytes.empty();
  }

 private:
  httplib::DataSink& sink_;
  const End& end_;
};

class LocalServer final : public WebServer, private httplib::Server {
 public:
  explicit LocalServer(const WebOptions& options) : answer_(options.answer), crew_(std::make_unique<Crew>(options.threads)) {
    new_task_queue = [this] { return crew_.release(); };
    set_socket_options([](socket_t socket) {  // and not that several may listen on one port, which is the usual
      const int yes = 1;
      ::setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof(yes));
    });
    set_tcp_nodelay(true);
    set_payload_max_length(payload_bytes_max);
    set_pre_routing_handler([this](const httplib::Request& request, httplib::Response& response) {
      forget_wishes(const_cast<httplib::Request&>(request));
      if (brings_json(request)) {
        return HandlerResponse::Unhandled;  // it is read first
      }
      answer(request, response, false);
      return HandlerResponse::Handled;
    });
    Post(".*", [this](const httplib::Request& request, httplib::Response& response) { answer(request, response, true); });
  }
  ~LocalServer() override {
    end_.come();
    if (listener_.joinable()) {
      stop();
      listener_.join();
    } else if (crew_) {
      crew_->shutdown();
    }
  }
  LocalServer(const LocalServer&) = delete;
  LocalServer& operator=(const LocalServer&) = delete;

  bool listen_at(std::uint16_t port) {
    constexpr const char* here = "127.0.0.1";
    const int bound = port == 0 ? bind_to_any_port(here) : bind_to_port(here, port) ? port : -1;
    if (bound <= 0) {
      return false;
    }
    port_ = static_cast<std::uint16_t>(bound);
    constexpr int many = 128;  // who comes when more than the library's five wait would come again a second later
    ::listen(svr_sock_, many);
    listener_ = std::jthread([this] { listen_after_bind(); });
    while (!is_running()) {  // what is stopped before would go on
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return true;
  }
  std::uint16_t port() const override { return port_; }

 private:
  /// What leaves a thread, for want of memory perhaps, would end the process.
  bool process_and_close_socket(socket_t socket) override {
    ::fcntl(socket, F_SETFD, FD_CLOEXEC);
    try {
      Connection connection(socket, end_);
      if (is_one_too_many) {
        constexpr std::string_view later = "HTTP/1.1 503 Service Unavailable\r\nConnection: close\r\nContent-Length: 0\r\n\r\n";
        return ::send(socket, later.data(), later.size(), MSG_NOSIGNAL | MSG_DONTWAIT) > 0;
      }
      bool is_closed = false;
      return process_request(connection, true, is_closed, {});
    } catch (const std::exception&) {
      return false;
    }
  }

  /// Nothing else is read: no text without a length, no form of many parts.
  static bool brings_json(const httplib::Request& request) {
    return request.method == "POST" && request.path.size() <= path_bytes_max && request.has_header("Content-Length") &&
           !request.has_header("Transfer-Encoding") && request.get_header_value("Content-Type") == "application/json";
  }

  /// Pages would be packed by Brotli, anew for each viewer, or given many times over, in pieces; and what is brought would be
  /// unpacked, to any length.
  static void forget_wishes(httplib::Request& request) {
    request.headers.erase("Accept-Encoding");
    request.headers.erase("Content-Encoding");
    request.headers.erase("Range");
    request.ranges.clear();
  }

  void answer(const httplib::Request& request, httplib::Response& response, bool is_json_read) {
    WebAnswer made = answer_({.method = request.method,
                              .path = request.path,
                              .host = request.get_header_value("Host"),
                              .origin = request.get_header_value("Origin"),
                              .fetch_site = request.get_header_value("Sec-Fetch-Site"),
                              .brings_json = is_json_read,
                              .json = is_json_read ? request.body : ""});
    response.status = made.status;
    for (const auto& [name, value] : made.headers) {
      response.set_header(name.c_str(), value);
    }
    if (!made.stream) {
      response.set_content(made.body, made.type.c_str());
      return;
    }
    response.set_chunked_content_provider(made.type.c_str(),
                                          [this, stream = std::move(made.stream)](std::size_t, httplib::DataSink& sink) {
                                            SinkStream to(sink, end_);
                                            stream(to);
                                            sink.done();
                                            return true;
                                          });
  }

  std::function<WebAnswer(const WebRequest&)> answer_;
  End end_;
  std::unique_ptr<Crew> crew_;  ///< until it is the server's
  std::uint16_t port_ = 0;
  std::jthread listener_;
};

std::unique_ptr<WebServer> listen(const WebOptions& options) {
  auto server = std::make_unique<LocalServer>(options);
  errno = 0;
  if (server->listen_at(options.port)) {
    return server;
  }
  const int error = errno;
  server.reset();
  errno = error;
  return nullptr;
}

constexpr WebLibrary library{.listen = listen};

}  // namespace
}  // namespace dmpc::apps

extern "C" __attribute__((visibility("default"))) const dmpc::apps::Module dmpc_module{DMPC_MODULES_BUILD, &dmpc::apps::library};

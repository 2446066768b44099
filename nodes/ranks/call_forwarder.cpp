#include "nodes/ranks/call_forwarder.h"

#include <utility>

#include "nodes/ranks/dismissal.h"
#include "nodes/ranks/fabric.h"

namespace dmpc::nodes {

namespace {

/// The exception that it throws, or nothing.
std::exception_ptr failure_in(const std::function<void()>& act) {
  try {
    act();
    return nullptr;
  } catch (...) {
    return std::current_exception();
  }
}

}  // namespace

void CallForwarder::send(const std::function<void()>& act) {
  ForwardedCall forwarded_call{.act = &act};
  {
    std::unique_lock lock(mutex_);
    if (failure_) {
      end(forwarded_call, failure_);
    } else {
      pending_ = &forwarded_call;
      news_.notify_all();
      news_.wait(lock, [&forwarded_call] { return forwarded_call.is_done; });
    }
  }
  if (forwarded_call.failure) {
    std::rethrow_exception(forwarded_call.failure);
  }
}

bool CallForwarder::is_end_of_all(const std::exception_ptr& failure) {
  try {
    std::rethrow_exception(failure);
  } catch (const Dismissed&) {
    return true;
  } catch (const LostRank&) {
    return true;
  } catch (...) {
    return false;
  }
}

bool CallForwarder::do_one(std::chrono::milliseconds timeout) {
  std::unique_lock lock(mutex_);
  news_.wait_for(lock, timeout, [this] { return is_over_ || pending_ != nullptr; });
  if (pending_ == nullptr) {
    return is_over_;
  }
  ForwardedCall& forwarded_call = *std::exchange(pending_, nullptr);
  lock.unlock();
  std::exception_ptr failure = failure_in(*forwarded_call.act);
  lock.lock();
  end(forwarded_call, std::move(failure));
  return false;
}

void CallForwarder::end(ForwardedCall& forwarded_call, std::exception_ptr failure) {
  forwarded_call.failure = std::move(failure);
  forwarded_call.is_done = true;
  news_.notify_all();
}

void CallForwarder::end_work() {
  const std::lock_guard lock(mutex_);
  is_over_ = true;
  news_.notify_all();
}

void CallForwarder::fail(const std::exception_ptr& failure) {
  const std::lock_guard lock(mutex_);
  failure_ = failure_ ? failure_ : failure;
  if (pending_ != nullptr) {
    end(*std::exchange(pending_, nullptr), failure_);
  }
}

}  // namespace dmpc::nodes

// Several observers of one run.
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "nodes/observer.h"

namespace dmpc::nodes {

/// Reports to all of them, in order. Thread safety: as theirs.
class ObserverGroup final : public Observer {
 public:
  /// The members outlive it.
  explicit ObserverGroup(std::vector<Observer*> members) : members_(std::move(members)) {}

  void ended(const Span& span, const Program& program) override {
    for (Observer* const member : members_) {
      member->ended(span, program);
    }
  }
  void sent(const Passing& packet) override {
    for (Observer* const member : members_) {
      member->sent(packet);
    }
  }
  void received(const Passing& packet) override {
    for (Observer* const member : members_) {
      member->received(packet);
    }
  }
  void waited(const Waited& wait) override {
    for (Observer* const member : members_) {
      member->waited(wait);
    }
  }
  void worked(const Worked& worked) override {
    for (Observer* const member : members_) {
      member->worked(worked);
    }
  }
  bool follows_paths() const override {
    return std::any_of(members_.begin(), members_.end(), [](const Observer* member) { return member->follows_paths(); });
  }

 private:
  std::vector<Observer*> members_;
};

}  // namespace dmpc::nodes

// Visits every state that a model can reach, and judges them one by one and all together.
//
// A model has a State, initial(), key(state) (equal keys, equal states), for_each_step(state, visit), check(state),
// is_end(state), is_quiet(state) and text(action). Breadth first, so the way to a failure is as short as any.
#pragma once

#include <doctest/doctest.h>

#include <algorithm>
#include <cstdint>
#include <deque>
#include <exception>
#include <stdexcept>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

namespace dmpc::tests {

/// What an exploration found.
struct StateReport {
  std::uint64_t states = 0, steps = 0;
  std::string failure{};           ///< what went wrong, or empty
  std::vector<std::string> way{};  ///< the steps from the start to the failure
};

/// Failures: check() throws; a state that is no end has no step (a deadlock); from some state no end can be reached; steps go
/// round in a circle, other than idle steps (such as a token's) while the state is not quiet, where only a step that is put off
/// for ever can be to blame.
template <class Model>
class StateExplorer {
 public:
  explicit StateExplorer(const Model& model) : model_(model) {}

  StateReport explore() {
    try {
      visit_all();
      judge_whole();
    } catch (const std::exception& error) {
      report_.failure = error.what();
      report_.way = way_to(current_);
    }
    report_.states = parents_.size();
    return report_;
  }

 private:
  using State = typename Model::State;
  using Action = typename Model::Action;

  struct Failure : std::runtime_error {
    using std::runtime_error::runtime_error;
  };
  struct Edge {
    std::uint32_t from, to;
    bool is_progress;  ///< may not be part of a circle
  };
  struct Parent {
    std::uint32_t state;
    Action action;
  };

  void visit_all() {
    add(model_.initial(), 0, Action{});
    while (!pending_.empty()) {
      const State state = std::move(pending_.front());
      pending_.pop_front();
      step_from(state);
      ++current_;
    }
  }

  /// States are numbered in the order in which they are found, which is the order in which they are visited.
  void step_from(const State& state) {
    model_.check(state);
    is_end_.push_back(model_.is_end(state));
    const bool is_quiet = model_.is_quiet(state);
    std::size_t count = 0;
    model_.for_each_step(state, [&](const Action& action, const State& next) {
      ++count;
      edges_.push_back({current_, add(next, current_, action), is_quiet || !action.is_idle()});
    });
    report_.steps += count;
    if (count == 0 && !is_end_.back()) {
      throw Failure("deadlock: no step is possible, and this is not the end");
    }
  }

  std::uint32_t add(const State& state, std::uint32_t parent, const Action& action) {
    const auto [place, is_new] = numbers_.try_emplace(model_.key(state), static_cast<std::uint32_t>(parents_.size()));
    if (is_new) {
      parents_.push_back({parent, action});
      pending_.push_back(state);
    }
    return place->second;
  }

  void judge_whole() {
    expect_all(ends_reachable(), "no end can be reached from here");
    expect_all(outside_circles(), "steps go round in a circle from here");
  }

  void expect_all(const std::vector<bool>& good, const char* sentence) {
    for (current_ = 0; current_ < good.size(); ++current_) {
      if (!good[current_]) {
        throw Failure(sentence);
      }
    }
  }

  /// Which states have a way to an end: spreads from the ends against the steps.
  std::vector<bool> ends_reachable() const {
    const Lists before = lists(&Edge::to, &Edge::from);
    std::vector<bool> good = is_end_;
    std::vector<std::uint32_t> found;
    for (std::uint32_t i = 0; i < good.size(); ++i) {
      if (good[i]) {
        found.push_back(i);
      }
    }
    while (!found.empty()) {
      const std::uint32_t state = found.back();
      found.pop_back();
      for (std::uint32_t i = before.first[state]; i < before.first[state + 1]; ++i) {
        if (const std::uint32_t earlier = before.edge_end[i]; !good[earlier]) {
          good[earlier] = true;
          found.push_back(earlier);
        }
      }
    }
    return good;
  }

  /// Which states progress cannot lead to again and again: taken away in topological order (A. Kahn, 1962), others remain.
  std::vector<bool> outside_circles() const {
    std::vector<std::uint32_t> incoming(parents_.size(), 0);
    for (const Edge& edge : edges_) {
      incoming[edge.to] += edge.is_progress ? 1 : 0;
    }
    std::vector<std::uint32_t> ready;
    for (std::uint32_t i = 0; i < incoming.size(); ++i) {
      if (incoming[i] == 0) {
        ready.push_back(i);
      }
    }
    const Lists after = lists(&Edge::from, &Edge::to);
    std::vector<bool> good(parents_.size(), false);
    while (!ready.empty()) {
      const std::uint32_t state = ready.back();
      ready.pop_back();
      good[state] = true;
      for (std::uint32_t i = after.first[state]; i < after.first[state + 1]; ++i) {
        if (after.is_progress[i] && --incoming[after.edge_end[i]] == 0) {
          ready.push_back(after.edge_end[i]);
        }
      }
    }
    return good;
  }

  /// The edges sorted by one of their ends.
  struct Lists {
    std::vector<std::uint32_t> first, edge_end;
    std::vector<bool> is_progress;
  };
  Lists lists(std::uint32_t Edge::*by, std::uint32_t Edge::*other) const {
    Lists sorted{std::vector<std::uint32_t>(parents_.size() + 1, 0), std::vector<std::uint32_t>(edges_.size()),
                 std::vector<bool>(edges_.size())};
    for (const Edge& edge : edges_) {
      ++sorted.first[edge.*by + 1];
    }
    for (std::size_t i = 1; i < sorted.first.size(); ++i) {
      sorted.first[i] += sorted.first[i - 1];
    }
    std::vector<std::uint32_t> next(sorted.first.begin(), sorted.first.end() - 1);
    for (const Edge& edge : edges_) {
      const std::uint32_t place = next[edge.*by]++;
      sorted.edge_end[place] = edge.*other;
      sorted.is_progress[place] = edge.is_progress;
    }
    return sorted;
  }

  /// The steps from the start to a state, in order.
  std::vector<std::string> way_to(std::uint32_t state) const {
    std::vector<std::string> steps;
    for (; state != 0 && state < parents_.size(); state = parents_[state].state) {
      steps.push_back(parents_[state].action.text());
    }
    std::reverse(steps.begin(), steps.end());
    return steps;
  }

  const Model& model_;
  StateReport report_;
  std::unordered_map<std::string, std::uint32_t> numbers_;
  std::vector<Parent> parents_;
  std::vector<Edge> edges_;
  std::vector<bool> is_end_;
  std::deque<State> pending_;
  std::uint32_t current_ = 0;
};

/// No failure in any order of events; the way to it, step by step, otherwise.
inline void check_no_failure(const StateReport& report, std::uint64_t states_min) {
  std::string way;
  for (const std::string& step : report.way) {
    way += step + "\n";
  }
  INFO(way);
  CHECK(report.failure == "");
  CHECK(report.states >= states_min);
}

/// A failure that says `words`.
inline void check_failure(const StateReport& report, const std::string& words) {
  INFO(report.failure);
  CHECK(report.failure.find(words) != std::string::npos);
  CHECK_FALSE(report.way.empty());
}

}  // namespace dmpc::tests

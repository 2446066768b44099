#include "apps/computer/waiting.h"

#include <algorithm>
#include <cstddef>

#include "nodes/flat_bytes.h"

namespace dmpc::apps {
namespace {

/// Further entries are counted, not named.
constexpr std::size_t waiting_named_max = 3;
constexpr std::size_t circle_named_max = 16;

std::string text_of(const Unanswered& one, const std::string& preposition) {
  return std::to_string(one.count) + " '" + one.answer + "' " + preposition + " node " + std::to_string(one.node);
}

std::string list_text(const std::vector<Unanswered>& list, const std::string& verb, const std::string& preposition) {
  std::string text;
  for (std::size_t i = 0; i < std::min(list.size(), waiting_named_max); ++i) {
    text += i == 0 ? "; " + verb + " " : ", ";
    text += text_of(list[i], preposition);
  }
  return list.size() > waiting_named_max ? text + " and " + std::to_string(list.size() - waiting_named_max) + " more" : text;
}

/// An edge from a node to one that it waits for.
struct Step {
  std::uint32_t node = 0;
  std::size_t place = 0;  ///< index of the awaited entry
};

/// Depth-first search for a cycle among unvisited nodes.
class CircleSearch {
 public:
  explicit CircleSearch(const std::vector<std::vector<Unanswered>>& awaited) : awaited_(awaited), visits_(awaited.size()) {}

  std::vector<Step> find() {
    for (std::uint32_t start = 0; start < awaited_.size(); ++start) {
      if (visits_[start] == Visit::none && has_circle_from(start)) {
        return circle_;
      }
    }
    return {};
  }

 private:
  enum class Visit : std::uint8_t { none, on_way, done };

  bool has_circle_from(std::uint32_t start) {
    way_ = {{start, 0}};
    visits_[start] = Visit::on_way;
    while (!way_.empty()) {
      Step& last = way_.back();
      if (last.place == awaited_[last.node].size()) {
        visits_[last.node] = Visit::done;
        way_.pop_back();
        if (!way_.empty()) {
          ++way_.back().place;
        }
      } else if (const std::uint32_t next = awaited_[last.node][last.place].node; visits_[next] == Visit::on_way) {
        take_circle(next);
        return true;
      } else if (visits_[next] == Visit::none) {
        visits_[next] = Visit::on_way;
        way_.push_back({next, 0});
      } else {
        ++last.place;
      }
    }
    return false;
  }

  void take_circle(std::uint32_t begin) {
    const auto first = std::find_if(way_.begin(), way_.end(), [&](const Step& step) { return step.node == begin; });
    circle_.assign(first, way_.end());
    std::rotate(circle_.begin(),
                std::min_element(circle_.begin(), circle_.end(), [](const Step& a, const Step& b) { return a.node < b.node; }),
                circle_.end());
  }

  const std::vector<std::vector<Unanswered>>& awaited_;
  std::vector<Visit> visits_;
  std::vector<Step> way_;
  std::vector<Step> circle_;  ///< from its lowest node on; each step leads to the next one's node
};

}  // namespace

std::string flat_bytes(const std::vector<Unanswered>& list) {
  nodes::FlatWriter flat;
  flat.put(list.size());
  for (const Unanswered& one : list) {
    flat.put(one.node);
    flat.put_bytes(one.answer);
    flat.put(one.count);
  }
  return flat.take();
}

std::vector<Unanswered> unanswered_from(const std::string& bytes) {
  nodes::FlatReader flat(bytes);
  std::vector<Unanswered> list(flat.take<std::size_t>());
  for (Unanswered& one : list) {
    one.node = flat.take<std::uint32_t>();
    one.answer = flat.take_bytes();
    one.count = flat.take<std::uint32_t>();
  }
  return list;
}

std::string waiting_text(const std::vector<Unanswered>& awaited, const std::vector<Unanswered>& owed) {
  return list_text(awaited, "waits for", "of") + list_text(owed, "owes", "to");
}

std::string circle_text(const std::vector<std::vector<Unanswered>>& awaited) {
  const std::vector<Step> circle = CircleSearch(awaited).find();
  if (circle.empty()) {
    return "";
  }
  std::string text = "\nin a circle: node " + std::to_string(circle.front().node);
  for (std::size_t i = 0; i < std::min(circle.size(), circle_named_max); ++i) {
    const std::uint32_t next = awaited[circle[i].node][circle[i].place].node;
    text += i == 0 ? " waits for node " : ", that for node ";
    text += std::to_string(next);
  }
  return circle.size() > circle_named_max ? text + ", and so on, " + std::to_string(circle.size()) + " nodes in all" : text;
}

}  // namespace dmpc::apps

// PageRank (L. Page, S. Brin, R. Motwani, T. Winograd, 1999) over pages: a round of it is a task for each vertex, which reads its
// edges and what their other ends have to give. Of another kind than pixels: references follow the graph.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

#include "core/picture/pixel_task.h"
#include "core/record/record.h"
#include "core/trace/charge.h"
#include "nodes/charge.h"
#include "tests/support/small_machine.h"

namespace dmpc::tests {

/// A vertex's edges come from few others, which most have in common.
struct Graph {
  std::uint32_t vertex_count = 0;
  std::vector<std::vector<std::uint32_t>> sources;  ///< sources of the edges to each vertex
  std::vector<std::uint32_t> out_degrees;
};

inline Graph random_graph(std::uint32_t vertex_count, std::uint32_t degree, std::uint64_t seed) {
  Graph graph{vertex_count, std::vector<std::vector<std::uint32_t>>(vertex_count), std::vector<std::uint32_t>(vertex_count)};
  for (std::uint32_t vertex = 0; vertex < vertex_count; ++vertex) {
    for (std::uint32_t edge = 0; edge < core::mix(seed + vertex) % (2 * degree); ++edge) {
      const std::uint64_t draw = core::mix(seed ^ (std::uint64_t{vertex} << 32U | edge));
      const auto source = static_cast<std::uint32_t>((draw >> 32U) % (1 + draw % vertex_count));  // low numbers more often
      graph.sources[vertex].push_back(source);
      ++graph.out_degrees[source];
    }
  }
  return graph;
}

/// How many rounds a rank takes to be the same to the last bit is not asked here: a few show all that there is.
inline constexpr double damping = 0.85;

/// In 8 bytes each: per vertex where its edges begin, one more, the edges, and what each vertex gives along an edge.
class RankPages {
 public:
  RankPages(const Graph& graph, std::size_t page_size) : graph_(graph) {
    std::uint64_t edges = graph.vertex_count + 1;
    for (const auto& sources : graph.sources) {
      words_.push_back(edges);
      edges += sources.size();
    }
    words_.push_back(edges);
    for (const auto& sources : graph.sources) {
      for (const std::uint32_t source : sources) {
        words_.push_back(edges + source);
      }
    }
    given_ = words_.size();
    const std::size_t page_words = page_size / sizeof(std::uint64_t);
    words_.resize((given_ + graph.vertex_count + page_words - 1) / page_words * page_words);
  }

  std::span<const std::byte> bytes() const { return std::as_bytes(std::span(words_)); }

  void give(const std::vector<double>& ranks) {
    for (std::uint32_t vertex = 0; vertex < graph_.vertex_count; ++vertex) {
      const std::uint32_t degree = graph_.out_degrees[vertex];
      words_[given_ + vertex] = std::bit_cast<std::uint64_t>(degree == 0 ? 0.0 : damping * ranks[vertex] / degree);
    }
  }

 private:
  const Graph& graph_;
  std::vector<std::uint64_t> words_;
  std::size_t given_ = 0;
};

/// The next rank of a vertex, in the order of its edges, so that sums are rounded alike everywhere.
class RankTask {
 public:
  using Result = double;
  static constexpr std::uint32_t edges_a_step = 8;

  void start(std::uint32_t vertex) {
    *this = {};
    at_ = vertex;
  }

  template <class Records>
  core::TaskState run(Records& records, nodes::Charges& charges) {
    for (std::uint32_t edges = 0; edges < edges_a_step;) {
      std::uint64_t word = 0;
      if (!read(records, has_source_ ? source_ : at_, word)) {
        return core::TaskState::absent;
      }
      if (has_bounds_ < 2) {
        take_bound(word);
      } else if (has_source_) {
        sum_ += std::bit_cast<double>(word);
        charges[core::Charge::cell_step] += 1;
        has_source_ = false;
        ++edges;
      } else {
        source_ = word;
        has_source_ = true;
        ++at_;
      }
      if (has_bounds_ == 2 && at_ == end_ && !has_source_) {
        return core::TaskState::finished;
      }
    }
    return core::TaskState::more;
  }

  core::Address absent() const { return absent_; }
  double result() const { return 1 - damping + sum_; }

 private:
  template <class Records>
  bool read(Records& records, std::uint64_t index, std::uint64_t& word) {
    absent_ = core::Address{static_cast<std::uint32_t>(index)};
    const std::byte* const place = records.find(absent_);
    if (place != nullptr) {
      std::memcpy(&word, place, sizeof(word));
    }
    return place != nullptr;
  }

  void take_bound(std::uint64_t word) {
    (has_bounds_ == 0 ? begin_ : end_) = word;
    ++has_bounds_;
    at_ = has_bounds_ == 2 ? begin_ : at_ + 1;
  }

  std::uint64_t at_ = 0, begin_ = 0, end_ = 0, source_ = 0;
  std::uint32_t has_bounds_ = 0;
  bool has_source_ = false;
  double sum_ = 0;
  core::Address absent_ = core::no_address;
};
static_assert(core::record_alignment == sizeof(std::uint64_t));

/// After so many rounds, in one memory.
inline std::vector<double> ranks_in_one_memory(const Graph& graph, std::uint32_t rounds) {
  std::vector<double> ranks(graph.vertex_count, 1);
  for (std::uint32_t round = 0; round < rounds; ++round) {
    std::vector<double> next;
    for (const auto& sources : graph.sources) {
      double sum = 0;
      for (const std::uint32_t source : sources) {
        sum += damping * ranks[source] / graph.out_degrees[source];
      }
      next.push_back(1 - damping + sum);
    }
    ranks = next;
  }
  return ranks;
}

}  // namespace dmpc::tests

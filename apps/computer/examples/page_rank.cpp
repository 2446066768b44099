// PageRank (L. Page, S. Brin, R. Motwani, T. Winograd, 1999) of a graph that does not fit a node: its pages are distributed over
// all nodes, and a round has one task per vertex, which reads its edges and the contributions of their sources.
//
//   page_rank --runner=virtual --machine=hdr --cache-pages=64
//
// takes 24.5 ms of virtual time, and 11.6 % of its look-ups are faults; with 16 pages 66.1 ms and 31.0 %, with 128 3.53 ms and
// 1.2 %, with 256 2.54 ms and 0.6 %, which is each page once. Result: of the 1,563 pages the 157 with contributions are read
// repeatedly, most often those of the few vertices with many outgoing edges, while edges are read only once. So a cache of a
// tenth of the data is as good as one of all data. The replacement policy matters: in order of arrival (fifo) edges evict
// contributions, and with 128 pages 2.9 % of look-ups are faults instead of 1.2 %.
#include <dmpc/pages.h>

#include <algorithm>
#include <bit>
#include <string>

using Word = std::uint64_t;

enum Operations : dmpc::Index { addition };

constexpr double damping = 0.85;

/// A few vertices have many outgoing edges.
struct Graph {
  std::vector<std::vector<std::uint32_t>> sources;  ///< sources of the edges to each vertex
  std::vector<std::uint32_t> out_degrees;
};

Word mixed(Word value) {
  value = (value ^ value >> 30U) * 0xbf58476d1ce4e5b9U;
  value = (value ^ value >> 27U) * 0x94d049bb133111ebU;
  return value ^ value >> 31U;
}

Graph graph_of(std::uint32_t vertices, std::uint32_t degree) {
  Graph graph{std::vector<std::vector<std::uint32_t>>(vertices), std::vector<std::uint32_t>(vertices)};
  for (std::uint32_t vertex = 0; vertex < vertices; ++vertex) {
    for (std::uint32_t edge = 0; edge < degree; ++edge) {
      const Word draw = mixed(Word{vertex} << 32U | (edge + 1));
      const auto limit = static_cast<std::uint32_t>(1 + draw % vertices);  // favours low numbers
      graph.sources[vertex].push_back(static_cast<std::uint32_t>(draw >> 32U) % limit);
      ++graph.out_degrees[graph.sources[vertex].back()];
    }
  }
  return graph;
}

/// The data in words: for each vertex the index of its first edge, and one more; for each edge the index of its source's
/// contribution; the contributions.
class Layout {
 public:
  explicit Layout(const Graph& graph) : graph_(graph), words_(graph.sources.size() + 1) {
    for (std::size_t vertex = 0; vertex < graph.sources.size(); ++vertex) {
      words_[vertex + 1] = graph.sources[vertex].size() + (vertex == 0 ? words_.size() : words_[vertex]);
    }
    words_[0] = words_.size();
    const Word gifts = words_.back();
    for (const auto& sources : graph.sources) {
      for (const std::uint32_t source : sources) {
        words_.push_back(gifts + source);
      }
    }
  }

  /// Returns the data with each vertex's contribution per edge.
  std::vector<Word> with_gifts(const std::vector<double>& ranks) const {
    std::vector<Word> words = words_;
    for (std::size_t vertex = 0; vertex < ranks.size(); ++vertex) {
      words.push_back(std::bit_cast<Word>(damping * ranks[vertex] / std::max(1U, graph_.out_degrees[vertex])));
    }
    return words;
  }

 private:
  const Graph& graph_;
  std::vector<Word> words_;
};

/// Computes the next rank of a vertex. It keeps what it has read, so that it can continue after an absent page.
class RankTask {
 public:
  explicit RankTask(std::uint32_t vertex) : vertex_(vertex) {}

  dmpc::Step run(dmpc::Pages& pages) {
    if (!has_edges_) {
      has_edges_ = pages.read((vertex_ + 1) * sizeof(Word), end_) && pages.read(vertex_ * sizeof(Word), edge_);
      return has_edges_ ? dmpc::Step::more : dmpc::Step::absent;
    }
    if (edge_ == end_) {
      return dmpc::Step::finished;
    }
    if (!has_place_ && !pages.read(edge_ * sizeof(Word), place_)) {
      return dmpc::Step::absent;
    }
    has_place_ = true;
    double gift = 0;
    if (!pages.read(place_ * sizeof(Word), gift)) {
      return dmpc::Step::absent;
    }
    sum_ += gift;
    pages.charge(addition);
    has_place_ = false;
    return ++edge_ == end_ ? dmpc::Step::finished : dmpc::Step::more;
  }

  double result() const { return 1 - damping + sum_; }

 private:
  Word vertex_, edge_ = 0, end_ = 0, place_ = 0;
  bool has_edges_ = false, has_place_ = false;
  double sum_ = 0;
};

/// Computes the next ranks sequentially in the same order, and so bit by bit the same.
std::vector<double> next_ranks(const Graph& graph, const std::vector<double>& ranks) {
  std::vector<double> next;
  for (const auto& sources : graph.sources) {
    double sum = 0;
    for (const std::uint32_t source : sources) {
      sum += damping * ranks[source] / graph.out_degrees[source];
    }
    next.push_back(1 - damping + sum);
  }
  return next;
}

int main(int count, char** words) {
  std::uint32_t vertices = 20000, degree = 8, rounds = 3;
  const auto act = [&](dmpc::PagedComputer& computer) {
    const Graph graph = graph_of(vertices, degree);
    const Layout layout(graph);
    std::vector<double> ranks(vertices, 1), expected = ranks;
    for (std::uint32_t round = 0; round < rounds; ++round) {
      const std::vector<Word> data = layout.with_gifts(ranks);
      ranks = computer.run(std::span<const Word>(data), vertices, [](std::uint32_t vertex) { return RankTask(vertex); });
      expected = next_ranks(graph, expected);
    }
    return "rank of vertex 0: " + std::to_string(ranks[0]) + (ranks == expected ? ", as in one memory" : ", WRONG");
  };
  return dmpc::run_tasks(count, words,
                         {.description = "Rank the vertices of a graph whose pages are distributed over the nodes",
                          .options = {{"--vertices", &vertices, 1, 10'000'000, "Vertices of the graph"},
                                      {"--degree", &degree, 1, 1000, "Edges to each vertex"},
                                      {"--rounds", &rounds, 1, 1000, "Number of iterations"}},
                          .operations = {{"addition", 1}},
                          .act = act});
}

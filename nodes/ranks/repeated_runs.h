// Several runs on the same nodes, as rank 0 announces them to the other ranks: a job for the first, from which they make their
// nodes, and for each that follows the one value in which it differs.
#pragma once

#include <cstdint>
#include <functional>
#include <stop_token>
#include <string>
#include <string_view>

#include "core/base/expect.h"
#include "nodes/byte_source.h"
#include "nodes/flat_bytes.h"
#include "nodes/observers/watching.h"
#include "nodes/ranks/rank_memory.h"
#include "nodes/ranks/streams.h"
#include "nodes/runner.h"

namespace dmpc::nodes {

/// The content of a stream from rank 0, by its first byte.
enum class StreamKind : std::uint8_t {
  job,   ///< a run on new nodes, which are made from what follows
  again  ///< another run on the existing nodes
};

/// The kind of a stream whose first read_counted() returned `bytes`.
inline StreamKind kind_of_stream(std::string_view bytes) {
  core::expect(!bytes.empty(), "a stream says what it is about");
  return StreamKind{static_cast<std::uint8_t>(bytes.front())};
}

/// A worker rank's callbacks for a run that rank 0 coordinates.
struct WorkerCallbacks {
  /// Called when the plan is known, before memory is allocated; throws if this rank has not enough memory.
  std::function<void(const RankMemory&)> check_room = [](const RankMemory&) {};
  /// Called next, if rank 0 wants the nodes observed, with its order: returns the observers here.
  std::function<Watching(std::string_view order)> watch = [](std::string_view) { return Watching(); };
  /// Called before each run except the first, if several follow each other on the same nodes: resets the observers.
  std::function<void()> watch_again = [] {};
  /// Called after the run: returns what was observed here, in the format of WatchingElsewhere::add() of rank 0.
  std::function<std::string()> seen = [] { return std::string(); };
};

/// The outcome of a run for a worker rank.
struct WorkerOutcome {
  RunEnd end = RunEnd::finished;
  std::uint64_t bytes_received = 0;  ///< all data from rank 0 before the run: a job, and its nodes' data
};

/// On rank 0, before another run on the existing nodes: sends each other rank the value. Returns when all have processed it.
/// Throws what fails on another rank.
template <class Value>
void hand_out_again(const Value& value, RankLinks& links) {
  FlatWriter flat;
  flat.put(StreamKind::again);
  flat.put(value);
  StreamsToRanks streams(links);
  streams.write_counted_to_all(flat.take());
  streams.finish();
}

/// Reads the value on a worker rank.
template <class Value>
Value read_again(std::string_view reported) {
  FlatReader flat(reported);
  core::expect(flat.take<StreamKind>() == StreamKind::again, "nodes that are there are told of another run");
  return flat.take<Value>();
}

/// The loop of a worker rank until rank 0 ends: throws Dismissed then, and what fails. `make_part(reported, stream)` makes the
/// nodes that are here from `reported` and the rest of the stream; they run, by `run(stop)`, and if `is_repeated()` again after
/// each `begin_again(reported)`, until they are replaced by others. If they are not to run again it returns after the first run.
template <class MakePart>
WorkerOutcome run_as_worker(RankLinks& links, const std::stop_token& stop, const MakePart& make_part) {
  StreamFromHost stream(links);
  std::string reported = read_counted(stream);
  while (true) {
    auto part = make_part(std::string_view(reported), stream);
    WorkerOutcome outcome{.bytes_received = stream.bytes_read()};
    outcome.end = part.run(stop);
    if (!part.is_repeated()) {
      return outcome;
    }
    while (kind_of_stream(reported = read_counted(stream)) == StreamKind::again) {
      part.begin_again(reported);
      part.run(stop);
    }
  }
}

}  // namespace dmpc::nodes

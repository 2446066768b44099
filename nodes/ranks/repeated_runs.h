// Several runs on the same nodes, as rank 0 tells the other ranks of them: a job for the first, of which they make their nodes,
// and for each that follows the one value in which it differs.
#pragma once

#include <cstdint>
#include <functional>
#include <stop_token>
#include <string>
#include <string_view>
#include <utility>

#include "core/base/expect.h"
#include "nodes/byte_source.h"
#include "nodes/flat_bytes.h"
#include "nodes/observers/watching.h"
#include "nodes/ranks/rank_memory.h"
#include "nodes/ranks/streams.h"
#include "nodes/runner.h"

namespace dmpc::nodes {

/// What a stream from rank 0 is about, by its first byte.
enum class StreamKind : std::uint8_t {
  job,   ///< a run on new nodes, which are made of what follows
  again  ///< another run on the nodes that are there
};

/// Of what read_counted() has read first.
inline StreamKind kind_of_stream(std::string_view bytes) {
  core::expect(!bytes.empty(), "a stream says what it is about");
  return StreamKind{static_cast<std::uint8_t>(bytes.front())};
}

/// What a rank brings to a run that rank 0 leads.
struct WorkerCallbacks {
  /// Called when the plan is known, before anything of it is set aside; throws if this rank has no room.
  std::function<void(const RankMemory&)> check_room = [](const RankMemory&) {};
  /// Called next, if rank 0 wants the nodes looked at, with what it orders: who looks on here.
  std::function<Watching(std::string_view order)> watch = [](std::string_view) { return Watching(); };
  /// Called before each run but the first, where several follow each other on the same nodes: what was seen is forgotten.
  std::function<void()> watch_again = [] {};
  /// Called then, when the run is over: what was seen here, as WatchingElsewhere::add() of rank 0 understands it.
  std::function<std::string()> seen = [] { return std::string(); };
};

/// How a run went for a rank that renders what rank 0 has handed out.
struct WorkerOutcome {
  RunEnd end = RunEnd::finished;
  std::uint64_t bytes_received = 0;  ///< all that it was told before the run: a job, and what its nodes keep during the run
};

/// On rank 0, before another run on the nodes that are there: sends each other rank the value. Returns when all have taken it up.
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

/// The value, from what another rank was told.
template <class Value>
Value read_again(std::string_view reported) {
  FlatReader flat(reported);
  core::expect(flat.take<StreamKind>() == StreamKind::again, "nodes that are there are told of another run");
  return flat.take<Value>();
}

/// What another rank does until rank 0 ends: throws Dismissed then, and what fails. `make_part(told, stream)` makes the nodes
/// that are here by what was told and the rest of the stream; they run, by `run(stop)`, and where `is_repeated()` run anew after
/// each `begin_again(told)`, until they give way to others. Where they are not to run anew it returns after the first run.
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

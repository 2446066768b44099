// What a render counted, as JSON with stable keys. Only stats.cpp and what it stands on name nlohmann-json.
#pragma once

#include <string>

#include "apps/run/render_record.h"

namespace dmpc::apps {

/// One JSON object, indented, with a line end. The keys are an interface; what does not apply is null, and no number is NaN or
/// infinite. "rays" below stands for primary, reflected, refracted, shadow, total.
///   program        name and version
///   options        what was asked for and what it became: scene, width, height, samples (a number or "auto"), error,
///                  samples_max, cutoff, depth, convention, tracer, grid_axes, record_order, structure, system, strategy, nodes,
///                  node_memory (bytes a node, the most), page_size; camera, light (a list), scale, up, smooth, missing (as the
///                  command line takes them, null where it said nothing); of pages: cache_pages, in_flight, work_item,
///                  work_giver, pixels, workers, count_pages; of dataflow: balance, cuts, regions_a_node, subsample,
///                  balance_grid, ray_batch, ray_credits, ray_places, ray_queue, tested_objects, backpressure, topology
///   runner         threads, virtual or mpi
///   machine        that was modelled, as machine_file.h says; null with threads, as is all that follows from virtual time
///   film_hash      of the film's integers, 16 hexadecimal digits: equal pictures, equal hashes
///   sampling       samples (of all pixels), resumed (how many of them a checkpoint had: no counter below has seen them, and
///                  those that judge the picture are null: deposits_saturated, but of a node, and mean_error_bound),
///                  samples_per_pixel, passes, and where they are refined estimated_error (root mean
///                  square of the linear channels)
///   rays           rays shot
///   hits           primary, secondary, shadow_blocked, total_internal_reflections
///   operations     cell_steps, brick_reads, triangle_tests, sphere_tests, cone_tests, shadings, normal_reads (vertex
///                  normals of smooth triangles), texture_lookups (hits on textured triangles), tile_reads (of their textures'
///                  tiles), bundles (of rays that walked together), rays_in_bundles, deposits_saturated
///   seconds        load, build, prepare (plan; for dataflow balance and deal), render, write (wall clock), user, system,
///                  render_user, render_system
///   run_hash       of all events in virtual time (with the packets' targets, kinds and bytes), the machine's digest and
///                  the film, 16 hexadecimal digits: equal runs, equal hashes, on any computer and in every build type
///   machine_digest of the machine's figures, switches and topology, but not its name
///   virtual_seconds   total (from the start to the last event), and summed over the nodes: computing, sending, receiving, stolen
///                  (by interrupts, from what there was to do), lent (to interrupts while there was nothing), waiting (by the
///                  kind of packet that ended it), end (nothing to do any more)
///   time_percent   the same summed up to 100: computing, data_wait (for pages or rays), work_wait (of a node of svm that has no
///                  pixels left, for another's), other_wait (for other packets), stolen, lent, messages (sending and receiving),
///                  idle_at_end (until a packet that ends the run, and after it)
///   events         in virtual time
///   links          messages, hops (links passed, summed over messages), wait (virtual seconds that messages stood before links
///                  that others held, summed), busiest (virtual seconds that the busiest link was held), used (links that carried
///                  anything); summed over these: passages (of messages), bytes (headers included), busy (virtual seconds held).
///                  columns {from, to, messages, bytes, busy, wait} and a row for each link, the busiest first, at most 256: as a
///                  rule all there are on machines of up to 32 nodes, though a crossbar has more. A wait counts for the link that
///                  became free last. The ends are "node 3", "host", "switch 0", "place 9" (a router without a node) and, of
///                  memory ports, "memory 3"
///   database       bytes, pages, page_size, forest_pages (before the first subtree of one tree), primitives, references,
///                  dropped, collapsed (of those, what rounding left nothing of); records by kind: bricks, triangle_blocks,
///                  sphere_blocks, cone_blocks, normals (of smooth triangles), textured (triangles), texture_tiles, materials,
///                  lights
///   packets        sent, received, bytes, overflow (by way of the host), and by_kind: packets and bytes
///   pages          references, hits, home_hits, cache_hits, misses, faults, evictions, served, distinct, distinct_per_pixel
///   work           pixels (over all passes), items_asked, items_taken, items_given
///   questions      of forest: rays_asked (what does a ray meet below a child), records_asked (what is in a record, for
///                  shading), rays_answered, records_answered, answers (received)
///   travel         of dataflow: rays_in and rays_out (rays), messages_per_ray (moves: rays sent over rays shot), packets (of
///                  rays), packets_flushed (sent before they were full), packets_queued (sent after a wait for credit), mean_fill
///                  (rays in a packet over those in a full one), bytes (headers included; in total those that the host forwards,
///                  too), overflow {rays, packets, share of the rays sent}, hits_sent_back (to the node that found them),
///                  tests_avoided (primitives that rays had tested elsewhere, by option tested_objects), queue_max and
///                  backlog_max (packets to send, and rays to trace, waiting on a node at once)
///   load           of dataflow: work_ps (picoseconds by measured prices), predicted_ps (of the subsampled picture), average and
///                  average_predicted (mean over maximum of the nodes)
///   regions        of dataflow: grid (finest cells along x, y, z), duplication (copies of primitives over primitives listed),
///                  part_bytes, primitive_copies, primary_rays (dealt before the start)
///   mapping        of dataflow: topology, mean_hops (links that a ray message passes), mean_hops_random (on random nodes)
///   pairs          of dataflow: columns {from, to, rays by kind, packets with rays, rays_overflowed}, and a row for each two
///                  nodes of which one has sent the other a ray
///   chaos          seed, packets_held, quanta_sat_out, and credits that were left: request_credits, ray_credits, host_credits,
///                  film_credits; null when calm
///   skips          work that was left out: empty_space, any_hit, unlit, zero_terms, empty_regions, background, bundles,
///                  idle_nodes, each {on, exact: true (it changes no bit of the picture), avoided, unit (of the work avoided)};
///                  cutoff {on, exact: false, cutoff, rays_cut, mean_error_bound: light that a sample lacks at most, on average}
///   heat_maps      for each file: kind, file, unit, clock ("processor time" or "virtual time", of time only), repeatable
///                  (another run gives the same bits), least, largest, sum (over pixels); null without any
///   nodes          for each node: rays, hits, operations, packets {sent, received, bytes: sent, bytes_received, refused: tried
///                  without credit}, pages, work, questions, travel, load {work_ps, predicted_ps}, region
///                  {low, high: corners in finest cells of the box around them, regions: their number, share of the grid's
///                  volume, part_bytes, primitive_copies, primary_rays}, memory {planned, used: bytes by category and in total},
///                  seconds {busy: computing, idle: asleep for want of packets, waiting for a core, wall}, quanta, sleeps
///   host           packets as of a node, deposits_saturated (on its film, over those of the nodes), seconds, sleeps; of
///                  dataflow: rays_kept_max (at once), kept_bytes_max (of its heap, beyond its plan), token_rounds
std::string stats_json(const RenderRecord& record);

}  // namespace dmpc::apps

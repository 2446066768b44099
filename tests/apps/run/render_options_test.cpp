#include "apps/run/render_options.h"

#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "apps/frontend/line/command_line.h"
#include "apps/main/commands.h"
#include "core/base/expect.h"
#include "core/base/units.h"
#include "nodes/runner.h"
#include "tests/support/tables.h"
#include "tests/support/text.h"
#include "tests/support/usage.h"

namespace dmpc::apps::render_options_test {

using namespace core;

using tests::contains;

namespace {

RenderOptions render(const std::vector<std::string>& more = {}) { return tests::typed_render(more); }

}  // namespace

TEST_CASE("a scene and an output are all that render needs") {
  const RenderOptions options = render();
  CHECK(options.picture.scene == "teapot-12");
  CHECK(options.image == "a.png");
  CHECK(options.strategy == Strategy::svm);
  CHECK(options.computer.node_count == 8);
  CHECK_FALSE(options.computer.node_memory_bytes);
  CHECK_FALSE(options.pages.cache_pages);
  CHECK(options.pages.replacement == svm::Replacement::lru);
  CHECK_FALSE(options.pages.in_flight);
  CHECK_FALSE(options.pages.work_item_side);
  CHECK(options.picture.skips == core::Skips{});
  CHECK(options.database.build.page_size_bytes == 1024);
  CHECK(options.database.build.record_order == core::RecordOrder::spatial);
  CHECK(options.database.build.structure == core::Structure::grid);
  CHECK_FALSE(options.picture.resolution);
  CHECK(options.picture.samples == 1);
  CHECK(options.picture.depth == 5);
  CHECK(options.picture.convention == Convention::haines);
  CHECK(options.tracer == TracerChoice::grid);
  CHECK_FALSE(options.stats);
  CHECK_FALSE(options.quiet);
  CHECK(options.runner.kind == RunnerKind::threads);
}

TEST_CASE("every option of the computer reaches its field") {
  const RenderOptions options = render({"--nodes=64", "--node-memory=4MiB", "--page-size=4KiB", "--record-order=scattered",
                                        "--cache-pages=5", "--replacement=clock", "--in-flight=7", "--work-item=0",
                                        "--no-skip=any-hit", "--count-pages", "--stats=s.json", "--quiet"});
  CHECK(options.computer.node_count == 64);
  CHECK(options.computer.node_memory_bytes == 4_MiB);
  CHECK(options.database.build.page_size_bytes == 4_KiB);
  CHECK(options.database.build.record_order == core::RecordOrder::scattered);
  CHECK(options.pages.cache_pages == 5);
  CHECK(options.pages.replacement == svm::Replacement::clock);
  CHECK(options.pages.in_flight == 7);
  CHECK(options.pages.work_item_side == 0);
  CHECK_FALSE(options.picture.skips.any_hit);
  CHECK(options.pages.count_pages);
  CHECK(options.stats == "s.json");
  CHECK(options.quiet);
}

TEST_CASE("skips are switched off by name, several at a time, or all") {
  const auto skips = [](const std::vector<std::string>& words) { return render(words).picture.skips; };
  CHECK(skips({"--no-skip=unlit"}) == core::Skips{.unlit = false});
  const core::Skips two{.any_hit = false, .zero_terms = false};
  CHECK(skips({"--no-skip=any-hit,zero-terms"}) == two);
  CHECK(skips({"--no-skip=any-hit", "--no-skip=zero-terms,any-hit"}) == two);
  CHECK(skips({"--no-skip=all"}) == core::no_skips());
  for (const core::Skip& skip : core::all_skips) {
    CHECK(skips({std::string("--no-skip=") + skip.name}) == core::without(skip));
  }
}

TEST_CASE("any seed makes chaos, and without one the computer is calm") {
  CHECK_FALSE(render().computer.chaos);
  CHECK(render({"--chaos=0"}).computer.chaos.value().seed == 0);
  CHECK(render({"--chaos=18446744073709551615", "--strategy=replicated"}).computer.chaos.value().seed == ~std::uint64_t{0});
}

TEST_CASE("every option of the picture reaches its field") {
  const RenderOptions options = render({"--resolution=64x48", "--samples=4", "--depth=9", "--convention=paper",
                                        "--strategy=replicated", "--tracer=embree", "--node-memory=auto"});
  REQUIRE(options.picture.resolution);
  CHECK(options.picture.resolution->width == 64);
  CHECK(options.picture.resolution->height == 48);
  CHECK(options.picture.samples == 4);
  CHECK(options.picture.depth == 9);
  CHECK(options.picture.convention == Convention::paper);
  CHECK(options.strategy == Strategy::replicated);
  CHECK(options.tracer == TracerChoice::embree);
  CHECK_FALSE(options.computer.node_memory_bytes);
}

TEST_CASE(
    "samples refined to an error start with two a pixel, and the error is an eight-bit step, by paths a hundredth, unless said") {
  const PictureOptions options = render({"--samples=auto"}).picture;
  CHECK(options.is_refined);
  CHECK(options.samples == 2);
  CHECK(options.refinement.error == doctest::Approx(1.0 / 255));
  CHECK(render({"--error=2/255", "--samples=auto"}).picture.refinement.error == doctest::Approx(2.0 / 255));
  CHECK(render({"--samples=auto", "--transport=paths"}).picture.refinement.error == 0.01);
  CHECK(render({"--quality=good", "--transport=paths"}).picture.refinement.error == doctest::Approx(1.0 / 255));
  CHECK(render({"--samples=auto", "--samples-max=64"}).picture.refinement.samples_max == 64);
  CHECK_FALSE(render().picture.refinement.is_wanted());
}

TEST_CASE("a mesh file has at most 256 samples a pixel unless said") {
  const auto samples_max = [](const char* scene, const char* said) {
    const std::vector<std::string> line{"render", scene, said, "-o", "a.png"};
    return parse_command_line(line).options<RenderOptions>().picture.refinement.samples_max;
  };
  CHECK(samples_max("a.obj", "--nodes=2") == 256);
  CHECK(samples_max("a.obj", "--transport=whitted") == 256);
  CHECK(samples_max("a.obj", "--samples-max=4096") == 4096);
  CHECK(samples_max("teapot-12", "--samples=auto") == 4096);
}

TEST_CASE("a refined picture may end by time or by the number of its passes") {
  CHECK_FALSE(render().seconds_max);
  CHECK(render({"--samples=auto", "--time=2.5"}).seconds_max == 2.5);
  CHECK(render({"--samples=auto"}).picture.refinement.passes == core::passes_max);
  CHECK(render({"--samples=auto", "--passes=3"}).picture.refinement.passes == 3);
}

TEST_CASE("the name that a quality had is taken for its name") {
  CHECK(render({"--quality=default"}).picture.quality == Quality::good);
}

TEST_CASE("a quality chooses what no other option has said") {
  const PictureOptions standard = render({"--quality=good"}).picture, draft = render({"--quality=draft"}).picture;
  CHECK(standard.is_refined);
  CHECK(standard.refinement.error == doctest::Approx(1.0 / 255));
  CHECK(draft.refinement.error > 2 * standard.refinement.error);
  CHECK(draft.cutoff > standard.cutoff);
  CHECK(render({"--quality=draft", "--cutoff=0"}).picture.cutoff == 0);
  CHECK(render({"--error=0.5", "--quality=draft"}).picture.refinement.error == 0.5);
  const PictureOptions even = render({"--quality=draft", "--samples=3"}).picture;
  CHECK(even.samples == 3);
  CHECK_FALSE(even.refinement.is_wanted());
}

namespace {

PictureOptions mesh(std::vector<std::string> more) {
  more.insert(more.begin(), {"render", "a.glb", "-o", "a.png"});
  return parse_command_line(more).options<RenderOptions>().picture;
}

}  // namespace

TEST_CASE("a mesh file that nobody has lit is shown by paths under a sky, refined to the default error without a cutoff") {
  const PictureOptions usual = mesh({});
  CHECK(usual.transport.is_by_paths());
  CHECK(usual.is_by_paths_unasked);
  CHECK(text_of(*usual.transport.sky) == text_of(mesh_sky()));
  CHECK(usual.scene_setup.background == mesh_sky().horizon);
  CHECK(usual.is_refined);
  CHECK(usual.is_refined_unasked);
  CHECK(usual.refinement.kind == core::ErrorKind::noise);
  CHECK(usual.refinement.error == 0.01);
  CHECK(usual.cutoff == 0);
  CHECK(usual.depth == 9);
  CHECK(mesh({"--sky=0.5"}).scene_setup.background == Vec3d{0.5, 0.5, 0.5});
  CHECK(mesh({"--bounces=2"}).depth == 3);
  CHECK(mesh({"--error=0.5"}).refinement.error == 0.5);
  CHECK_FALSE(mesh({"--error=0.5"}).is_refined_unasked);
  for (const char* const scene : {"teapot-12", "a.nff", "./a"}) {
    CHECK_FALSE(parse_command_line(std::vector<std::string>{"render", scene, "-o", "a.png"})
                    .options<RenderOptions>()
                    .picture.transport.is_by_paths());
  }
}

TEST_CASE("who says how a mesh file is lit gets what was asked for") {
  for (const char* const said : {"--transport=whitted", "--light=1,2,3", "--fill=0.3", "--ambient=0.1", "--convention=paper"}) {
    CAPTURE(said);
    CHECK_FALSE(mesh({said}).transport.is_by_paths());
    CHECK_FALSE(mesh({said}).is_by_paths_unasked);
  }
  CHECK(mesh({"--transport=paths"}).samples == 1);
  CHECK_FALSE(mesh({"--transport=paths"}).transport.sky);
  CHECK_FALSE(mesh({"--transport=paths"}).is_by_paths_unasked);
}

TEST_CASE("who says how well a mesh file is rendered changes nothing of its light, of a whole scene neither") {
  for (const char* const said : {"--samples=1", "--samples=16", "--samples=auto", "--samples-max=99", "--error=0.1",
                                 "--quality=draft", "--bounces=3", "--resolution=8x8"}) {
    CAPTURE(said);
    const PictureOptions asked = mesh({said});
    CHECK(asked.is_by_paths_unasked);
    CHECK(text_of(*asked.transport.sky) == text_of(mesh_sky()));
    const PictureOptions whole =
        parse_command_line(std::vector<std::string>{"render", "a.pbrt", said, "-o", "a.png"}).options<RenderOptions>().picture;
    CHECK(whole.transport.is_by_paths());
    CHECK(whole.transport.sky->file == "a.pbrt");
  }
  CHECK(mesh({"--samples=16"}).samples == 16);
  CHECK_FALSE(mesh({"--samples=16"}).is_refined);
  CHECK(mesh({"--quality=draft"}).cutoff == 0);
  CHECK(mesh({"--quality=draft", "--transport=whitted"}).cutoff > 0);
  CHECK(mesh({"--depth=3", "--transport=whitted"}).depth == 3);
}

TEST_CASE("a mesh file by Whitted's transport is refined to the default error unless samples or a quality are asked for") {
  const auto mesh = [](std::vector<std::string> more) {
    more.insert(more.begin(), "--transport=whitted");
    return render_options_test::mesh(more);
  };
  CHECK(mesh({}).is_refined);
  CHECK(mesh({}).is_refined_unasked);
  CHECK(mesh({}).samples == render({"--samples=auto"}).picture.samples);
  CHECK(mesh({}).refinement.error == render({"--quality=good"}).picture.refinement.error);
  CHECK(mesh({}).cutoff == 0);
  CHECK_FALSE(mesh({"--samples=1"}).is_refined);
  CHECK(mesh({"--quality=draft"}).refinement.error == render({"--quality=draft"}).picture.refinement.error);
  CHECK_FALSE(mesh({"--quality=good"}).is_refined_unasked);
  CHECK(mesh({"--error=0.5"}).refinement.error == 0.5);
  CHECK_FALSE(mesh({"--error=0.5"}).is_refined_unasked);
  for (const char* const scene : {"teapot-12", "a.nff", "./a"}) {
    CHECK_FALSE(
        parse_command_line(std::vector<std::string>{"render", scene, "-o", "a.png"}).options<RenderOptions>().picture.is_refined);
  }
}

TEST_CASE("a cutoff is exact unless said otherwise") {
  CHECK(render().picture.cutoff == 0);
  CHECK(render({"--cutoff=0"}).picture.cutoff == 0);
  CHECK(render({"--cutoff=1/512"}).picture.cutoff == 1.0 / 512);
}

TEST_CASE("a value may follow its option as a word of its own") { CHECK(render({"--nodes", "3"}).computer.node_count == 3); }

TEST_CASE("the smallest and largest values are taken") {
  for (const std::string option : {"--nodes=1", "--nodes=4096", "--samples=32768", "--depth=1", "--depth=255", "--page-size=512B",
                                   "--page-size=64KiB", "--cache-pages=1", "--in-flight=4096", "--work-item=1024"}) {
    CAPTURE(option);
    CHECK_NOTHROW(render({option}));
  }
  for (const std::string option :
       {"--nodes=1024", "--ray-batch=1", "--ray-batch=546", "--ray-credits=0", "--ray-credits=64", "--ray-queue=0",
        "--ray-queue=16384", "--ray-slots=1", "--ray-slots=4096", "--tested-objects=0", "--tested-objects=8"}) {
    CAPTURE(option);
    CHECK_NOTHROW(render({"--strategy=dataflow", option}));
  }
}

TEST_CASE("voxels are made by one of two rules") {
  CHECK(render({"--structure=voxels"}).database.build.voxels == core::usual_voxels);
  for (const core::VoxelRule& rule : {core::usual_voxels, core::article_voxels}) {
    CHECK(render({"--structure=voxels", "--voxels=" + text_of(rule)}).database.build.voxels == rule);
  }
}

TEST_CASE("forest has one tree and pages of its own choice, unless one asks for others") {
  const core::BuildOptions build = render({"--strategy=forest"}).database.build;
  CHECK(build.structure == core::Structure::extents);
  CHECK(build.page_size_bytes == 4_KiB);
  CHECK(render({"--strategy=forest", "--page-size=1KiB", "--structure=extents"}).database.build.page_size_bytes == 1024);
  CHECK(render({"--structure=extents"}).database.build.structure == core::Structure::extents);
}

TEST_CASE("dataflow needs no option of its own") {
  const dataflow::RayOptions rays = render({"--strategy=dataflow"}).rays;
  CHECK(rays.balance.balance == dataflow::Balance::subsampled);
  CHECK(rays.balance.subsample == 8);
  CHECK_FALSE(rays.ray_batch);
  CHECK_FALSE(rays.ray_credits);
  CHECK_FALSE(rays.queue_packets);
  CHECK(rays.topology == nodes::TopologyKind::hypercube);
}

TEST_CASE("every option of dataflow reaches its field") {
  const RenderOptions options =
      render({"--strategy=dataflow", "--balance=subsampled", "--ray-batch=3", "--ray-credits=0", "--ray-queue=5"});
  CHECK(options.strategy == Strategy::dataflow);
  CHECK(options.rays.ray_batch == 3);
  CHECK(options.rays.ray_credits == 0);
  CHECK(options.rays.queue_packets == 5);
  CHECK(options.pages.work_donor == svm::WorkDonor::ring);
  CHECK(render({"--work-donor=host"}).pages.work_donor == svm::WorkDonor::host);
  CHECK(options.pages.homes == svm::PageHomes::spread);
  CHECK(render({"--homes=host"}).pages.homes == svm::PageHomes::host);
  CHECK(render({"--homes=tree"}).pages.homes == svm::PageHomes::tree);
  CHECK(render({"--resident=25"}).pages.resident_percent == 25);
  CHECK(options.pages.pixel_shares == svm::PixelShares::submaps);
  CHECK(render({"--pixels=interleaved"}).pages.pixel_shares == svm::PixelShares::interleaved);
  CHECK_FALSE(options.rays.without_backpressure);
  CHECK(render({"--strategy=dataflow", "--no-backpressure"}).rays.without_backpressure);
  CHECK(options.rays.balance.bsp.order == dataflow::CutOrder::longer_axis);
  CHECK(render({"--strategy=dataflow", "--cuts=alternating"}).rays.balance.bsp.order == dataflow::CutOrder::alternating);
  CHECK(render({"--strategy=dataflow", "--balance=equal-size"}).rays.balance.balance == dataflow::Balance::equal_size);
  const dataflow::BalanceOptions scattered = render({"--strategy=dataflow", "--balance=scattered", "--regions=4"}).rays.balance;
  CHECK(scattered.balance == dataflow::Balance::scattered);
  CHECK(scattered.regions_a_node == 4);
  const dataflow::BalanceOptions moving = render({"--strategy=dataflow", "--balance=moving", "--regions=4"}).rays.balance;
  CHECK(moving.balance == dataflow::Balance::moving);
  CHECK(moving.regions_a_node == 4);
}

TEST_CASE("a system by name stands for its options") {
  const RenderOptions machine = render({"--system=pixel-machine"});
  CHECK(machine.strategy == Strategy::svm);
  CHECK(machine.database.build.structure == core::Structure::extents);
  CHECK(machine.database.build.page_size_bytes == 1024);
  CHECK(machine.pages.pixel_shares == svm::PixelShares::interleaved);
  CHECK(machine.pages.homes == svm::PageHomes::host);
  CHECK(machine.pages.work_item_side == 0U);
  CHECK(options_of(System::pixel_machine) ==
        "--strategy=svm --structure=extents --work-item=0 --pixels=interleaved --homes=host");
  CHECK(options_of(System::green_paddon) == "--strategy=svm --structure=grid --work-donor=host --resident=50 --homes=tree");
  CHECK(options_of(System::svm_resident) == "--strategy=svm --structure=grid --work-donor=host --resident=50 --homes=spread");
  CHECK(options_of(System::forest_static) == "--strategy=forest --structure=extents --work-item=0 --pixels=interleaved");
  const RenderOptions forest = render({"--system=forest"});
  CHECK(forest.strategy == Strategy::forest);
  CHECK(forest.database.build.structure == core::Structure::extents);
  CHECK(forest.database.build.page_size_bytes == 4096);
  CHECK(render({"--system=replicated-extents"}).database.build.structure == core::Structure::extents);
  CHECK(render({"--system=replicated"}).database.build.structure == core::Structure::grid);
  CHECK(render({"--system=replicated", "--structure=voxels"}).database.build.structure == core::Structure::voxels);
  CHECK(render({"--system=green-paddon", "--structure=extents"}).database.build.structure == core::Structure::extents);
  CHECK(render({"--system=svm-extents"}).database.build.structure == core::Structure::extents);
  CHECK(render({"--system=svm-extents"}).database.build.page_size_bytes == 1024);
  CHECK(render({"--system=equal-size"}).rays.balance.balance == dataflow::Balance::equal_size);
  CHECK(render({"--system=subsampled"}).strategy == Strategy::dataflow);
  CHECK(render({"--system=svm"}).pages.homes == svm::PageHomes::spread);
  CHECK_FALSE(render().system);
}

TEST_CASE("the options of every system, given one by one, are those that its name stands for") {
  for (const SystemDescription& description : systems()) {
    CAPTURE(description.name);
    std::vector<std::string> words{"--system=" + std::string(description.name)};
    const std::string all = options_of(description.system);
    for (std::size_t at = 0; at < all.size();) {
      const std::size_t end = std::min(all.find(' ', at), all.size());
      words.push_back(all.substr(at, end - at));
      at = end + 1;
    }
    CHECK(words.size() > 2);
    CHECK(render(words).system == description.system);
    words.erase(words.begin());
    CHECK(render(words).strategy == render({"--system=" + std::string(description.name)}).strategy);
  }
}

TEST_CASE("options that every strategy has go with each") {
  for (const std::string strategy : {"svm", "replicated", "dataflow", "forest"}) {
    CAPTURE(strategy);
    CHECK_NOTHROW(render({"--strategy=" + strategy, "--nodes=2", "--node-memory=4MiB", "--page-size=2KiB", "--chaos=1",
                          "--no-skip=any-hit", "--stats=s.json", "--quiet"}));
  }
}

TEST_CASE("threads drive the computer unless a machine is to be modelled") {
  CHECK(render().runner.kind == RunnerKind::threads);
  const RunnerOptions standard = render({"--runner=virtual"}).runner;
  CHECK(standard.kind == RunnerKind::virtual_time);
  CHECK(standard.machine_name == "ipsc2");
  CHECK_FALSE(render({"--runner=virtual"}).computer.machine);
  CHECK(render({"--runner=virtual", "--machine=my.json"}).runner.machine_name == "my.json");
  CHECK(render({"--runner=threads", "--chaos=1"}).runner.kind == RunnerKind::threads);
}

TEST_CASE("a pool has as many threads as processors unless the line says how many, and so may each of several ranks") {
  CHECK_FALSE(render().computer.pool_threads);
  CHECK(render({"--runner=pool"}).runner.kind == RunnerKind::pool);
  CHECK(render({"--runner=pool"}).computer.pool_threads == nodes::processors_allowed());
  CHECK(render({"--runner=pool", "--pool-threads=3", "--chaos=1"}).computer.pool_threads == 3U);
  CHECK_FALSE(render({"--runner=mpi"}).computer.pool_threads);
  CHECK(render({"--runner=mpi", "--pool-threads=2"}).computer.pool_threads == 2U);
}

TEST_CASE("the help of render names the values and the defaults of options") {
  const std::string text = parse_command_line(std::vector<std::string>{"render", "--help=all"}).options<HelpText>().text;
  for (const auto& row : tests::rows_in("apps/run/render_help.txt", 1)) {
    CHECK_MESSAGE(contains(text, row[0]), row[0]);
  }
}

TEST_CASE("every strategy has the name that the command line knows") {
  for (const Strategy strategy : {Strategy::svm, Strategy::replicated, Strategy::dataflow, Strategy::forest}) {
    CHECK(render({std::string("--strategy=") + name_of(strategy)}).strategy == strategy);
  }
}

TEST_CASE("references can be written where nodes ask each other for pages and note their order, of a whole run") {
  CHECK_FALSE(render().references);
  CHECK(render({"--references=a.csv"}).references == "a.csv");
  CHECK(render({"--references=a.csv", "--runner=mpi"}).references == "a.csv");
}

TEST_CASE("a page needs a name that browsers know") {
  CHECK_FALSE(render().report);
  CHECK(render({"--report=a.html"}).report == "a.html");
}

TEST_CASE("paths have bounces in place of a depth, and a sky in place of a background") {
  CHECK(render().picture.transport.kind == TransportKind::whitted);
  const PictureOptions usual = render({"--transport=paths"}).picture;
  CHECK(usual.transport.is_by_paths());
  CHECK(usual.depth == 9);
  CHECK(usual.samples == 1);
  CHECK_FALSE(usual.scene_setup.background);
  CHECK(render({"--transport=paths", "--bounces=254"}).picture.depth == 255);
  const PictureOptions sky = render({"--transport=paths", "--sky=1,0.5,0.25/0.5", "--samples=64"}).picture;
  CHECK(sky.scene_setup.background == Vec3d{1, 0.5, 0.25});
  CHECK(sky.transport.sky->zenith == Vec3d{0.5, 0.5, 0.5});
  const PictureOptions picture = render({"--transport=paths", "--sky=skies/noon.exr", "--bounces=253"}).picture;
  CHECK(picture.transport.sky->file == "skies/noon.exr");
  CHECK(picture.scene_setup.background == Vec3d{});
}

TEST_CASE("by paths samples are refined from 16 on, in two passes, and a quality has no cutoff") {
  const PictureOptions refined = render({"--transport=paths", "--samples=auto", "--samples-max=16"}).picture;
  CHECK(refined.samples == 8);
  CHECK(refined.refinement.kind == core::ErrorKind::noise);
  CHECK_FALSE(refined.is_one_path_unasked);
  const PictureOptions draft = render({"--quality=draft", "--transport=paths"}).picture;
  CHECK(draft.is_refined);
  CHECK(draft.cutoff == 0);
  CHECK(draft.refinement.error == render({"--quality=draft"}).picture.refinement.error);
  CHECK(render({"--samples=auto"}).picture.refinement.kind == core::ErrorKind::edges);
}

TEST_CASE("instances are kept in one tree of extents, where rays go into them, and elsewhere refused with what to do") {
  CHECK_FALSE(render().database.build.keeps_instances);
  CHECK_FALSE(render({"--instances=expand"}).database.build.keeps_instances);
  CHECK(render({"--instances=expand"}).picture.scene_setup.mesh.copies == core::Copies::put);
  CHECK(render({"--instances=keep"}).picture.scene_setup.mesh.copies == core::Copies::left_out);
  for (const char* const strategy :
       {"--strategy=svm", "--strategy=replicated", "--strategy=forest", "--strategy=dataflow", "--system=forest"}) {
    const RenderOptions options = render({"--instances=keep", strategy});
    CHECK(options.database.build.keeps_instances);
    CHECK(options.database.build.structure == core::Structure::extents);
  }
  CHECK(render({"--instances=keep", "--structure=extents"}).database.build.keeps_instances);
  CHECK(render({"--instances=keep", "--strategy=dataflow", "--tested-objects=0"}).database.build.keeps_instances);
}

TEST_CASE("whether instances are kept the scene decides where that is open, unless something else does not go with it") {
  for (const char* const open :
       {"--strategy=svm", "--strategy=replicated", "--strategy=dataflow", "--structure=extents", "--system=svm-extents"}) {
    const RenderOptions options = render({"--instances=auto", open});
    CHECK(options.database.instances == InstancesChoice::automatic);
    CHECK(options.database.why_copied.empty());
    CHECK_FALSE(options.database.build.keeps_instances);
    CHECK(options.picture.scene_setup.mesh.copies == core::Copies::left_out);
  }
  CHECK(render({"--instances=auto"}).database.build.structure == core::Structure::grid);
  CHECK(render({"--instances=auto", "--strategy=dataflow", "--tested-objects=2"}).database.why_copied == "--tested-objects");
  for (const char* const other : {"--system=svm", "--structure=grid", "--structure=voxels", "--record-order=scattered"}) {
    const RenderOptions options = render({"--instances=auto", other});
    CHECK(options.database.why_copied == other);
    CHECK(options.picture.scene_setup.mesh.copies == core::Copies::put);
  }
}

}  // namespace dmpc::apps::render_options_test

// Lines that are refused before anything is done, and what is said of them.
#include <doctest/doctest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "apps/frontend/line/words.h"
#include "apps/main/commands.h"
#include "tests/support/text.h"
#include "tests/support/usage.h"

namespace dmpc::tests::refusals_test {

namespace {

using Words = std::vector<std::string>;

/// A line, and what its complaint has. A line's last word may stand for several, with | between; {} in the complaint is what then
/// stands there. A ~ is a blank within a word.
struct Refusal {
  const char* line;
  const char* complaint;
};

/// What a row leaves out: the scene and the picture.
const Refusal beginnings[] = {{"render", "render teapot-12 -o a.png"},
                              {"mesh", "render a.glb -o a.png"},
                              {"paths", "render teapot-12 -o a.png --transport=paths"},
                              {"dataflow", "render teapot-12 -o a.png --strategy=dataflow"},
                              {"virtual", "render teapot-12 -o a.png --runner=virtual"}};

/// Values that an option does not take.
const Refusal values[] = {
    {"render --nodes=0|4097|-1|many|2.5", "--nodes={}: expected a whole number from 1 to 4096"},
    {"dataflow --nodes=4097", "--nodes={}: "},
    {"render --strategy=dance|", "--strategy"},
    {"render --tracer=magic", "--tracer"},
    {"render --samples=0|32769|automatic|-1|1.5|AUTO|4x", "--samples={}: expected a whole number"},
    {"render --depth=0|256", "--depth={}: expected"},
    {"render --rank-timeout=60", "--rank-timeout goes with --runner=mpi"},
    {"render --rank-timeout=0|90000 --runner=mpi", "--rank-timeout"},
    {"render --convention=mine", "--convention"},
    {"render --cache-pages=0", "--cache-pages={}: expected"},
    {"render --in-flight=0|4097", "--in-flight={}: expected"},
    {"render --work-item=-1|1025", "--work-item={}: expected"},
    {"dataflow --balance=even", "--balance"},
    {"dataflow --cuts=third", "--cuts"},
    {"dataflow --ray-batch=0|683", "--ray-batch={}: expected"},
    {"dataflow --ray-credits=-1|65", "--ray-credits={}: expected"},
    {"dataflow --ray-queue=-1|16385", "--ray-queue={}: expected"},
    {"dataflow --ray-slots=0|4097", "--ray-slots={}: expected"},
    {"dataflow --tested-objects=9", "--tested-objects={}: expected"},
    {"dataflow --regions=0|1.5", "--regions={}: expected"},
    {"render --resident=101|-1", "--resident={}: expected"},
    {"render --homes=root", "--homes"},
    {"render --no-skip=everything|unlit,everything|unlit;any-hit|UNLIT||unlit,", "--no-skip"},
    {"render --resolution=512|x|5|5x|x5|0x5|5x0|-5x5|5x5x5|5X5|5~x5|65537x1|65536x65536|", "--resolution"},
    {"render --page-size=1000B|256B|128KiB", "--page-size={}: expected"},
    {"render --node-memory=lots", "--node-memory={}: expected"},
    {"render --chaos=-1|18446744073709551616|storm|1.5|7x", "--chaos={}: expected a whole number"},
    {"render --chaos=", "--chaos"},
    {"render --quality=best", "--quality"},
    {"render --cutoff=-0.1", "--cutoff={}: expected a number from 0 to 1"},
    {"render --structure=voxels --voxels=many|14:64", "--voxels={}: expected usual"},
    {"render --system=cray", "--system"},
    {"render --runner=magic", "--runner"},
    {"virtual --machine=", "--machine"},
    {"render --runner=pool --pool-threads=0", "--pool-threads"},
    {"render --instances=some", "--instances"},
    {"render --report=a.pdf", "--report={}: expected a file with the ending .html"},
    {"render --heatmap=rays|heat:a.png|RAYS:a.png|:a.png|rays:|rays:a|rays:a.jpg|rays:a.tif|", "--heatmap"},
    {"render --aov=albedo:|:a.exr|albedo:a.jpg|light|normal,|x:a.png|albedo;normal", "--aov={}: expected"},
    {"render --heatmap=colour:a.png", "faults|references|pages|rays|time|node|depth|samples|done"},
    {"render --trace=a.png|pftrace|a.gz|a.png.gz", ".pftrace"},
    {"render --trace=a.pftrace --trace-window=|,|1|2,1|1,1|-1,2|1,2,3|1;2|a,b|0,nan|0,1e30", "--trace-window"},
    {"render --checkpoint=a --checkpoint-every=0|-1|nan|inf|1e9|2s", "expected seconds"},
    {"render --frames=0",
     "--frames=0: expected how many frames, such as 24, or which, such as 3..7, of those from 1 to 1,000,000,000"},
    {"render --frames=-1||..|3..|..7|7..3|0..3|1.5|3...7|x|1000000001|99999999999999999999|1..1000000001", "--frames"},
    {"render "
     "--camera=|1,2,3|1,2/0,0,0|1,2,3/0,0,x|1,2,3/0,0,0/|1,2,3/0,0,0/0,1|1,2,3/0,0,0/0,1,0/45/1|1,2,3,4/0,0,0|nan,0,0/0,0,1",
     "--camera"},
    {"render --camera=inf,0,0/0,0,1|~1,2,3/0,0,0|1", "--camera="},
    {"render --camera=1,2,3/1,2,3", "different points"},
    {"render --camera=0,0,5/0,0,0/0,0,1", "not parallel"},
    {"render --camera=0,0,5/0,0,0/0,0,0", "not zero"},
    {"render --camera=0,0,5/0,0,0/0,1,0/0|0,0,5/0,0,0/0,1,0/180|0,0,5/0,0,0/0,1,0/x", "between 0 and 180"},
    {"render --camera=0,0,2e30/0,0,0", "1e30"},
    {"render --light=|1,2|1,2,3/|1,2,3/1|1,2,3/1,1,-1|1,2,3/1,1,1/1|1,2,nan|1|1e31,0,0", "--light"},
    {"mesh --scale=0|-1|inf|x|1e31", "--scale={}: expected"},
    {"mesh --up=w|-|--z|x,y", "--up={}: expected"},
    {"mesh --smooth=-1|181", "--smooth={}: expected"},
    {"mesh --smooth=", "--smooth"},
    {"mesh --missing=no", "--missing"},
    {"render --ambient=-1|1,2|0,0,-1|nan", "--ambient={}: expected R,G,B such as"},
    {"render --background=x|1e31|1,2,3,4", "--background={}: expected R,G,B such as"},
    {"render --fill=-0.1|1e31|0.3,0.3,0.3|much", "--fill={}: expected a number from 0 to 1e30"},
    {"paths --sky=-1|nan|1,inf,0|1,2|1/-1|1/1/1|1/", "--sky={}: expected a colour such as 1,1,1 or 0.5"},
    {"paths --sky=", "expected"},
    {"paths --clamp=0|-1|nan|inf|x|1e31", "--clamp={}: expected a radiance"},
    {"paths --bounces=255", "--bounces={}: expected a whole number from 0 to 254"},
    {"paths --sky=a.hdr --bounces=254", "--bounces={}: with an environment map expected at most 253"},
    {"paths --samples=auto --samples-max=15", "--samples-max={}: by paths expected at least 16"},
    {"info balls-1 --nodes=0|4097|", "--nodes"},
    {"info balls-1 --format=csv", "--format"},
    {"info balls-1 --page-size=3", "--page-size={}: expected"},
    {"info balls-1 --balance=none", "--balance"},
    {"compare a.exr b.exr --fail-above=|rmse|rmse:|rmse:-1|rmse:1/0|rmse:1/-2|rmse:x|:1|rmse:inf", "--fail-above"},
    {"compare a.exr b.exr --fail-above=rsme:0.1", "Did you mean rmse?"},
    {"study balance teapot-12 --nodes=,|4,|,4|4,,8|0|4097|-1|+4|4;8|4~8|4.5|x|99999999999", "with commas between"},
    {"study balance teapot-12 --nodes=", "--nodes"},
    {"study balance teapot-12 --format=xml", "--format"},
    {"study cache teapot-12 --cache-pages=4,0", "--cache-pages={}: expected"},
    {"study cache teapot-12 --nodes=1", "--nodes"},
    {"study speedup teapot-12 --nodes=4097", "--nodes={}: expected numbers from 1 to 4096"},
    {"study frames teapot-12 --machines=hdr,hdr", "--machines={}: hdr is there twice"},
    {"study frames teapot-12 --machines=hdr,abacus", "--machines={}: expected names of ipsc2"},
    {"study frames teapot-12 --nodes=1,8", "--nodes: expected at least 2"},
    {"study scale tetra", "dmpc study scale is no command any more: examples/scale.py"},
    {"study systems teapot-12 --systems=svm,abacus", "--systems"},
    {"study systems teapot-12 --tables=equal,best", "--tables"},
    {"study sweep balls-1 --vary=page-sise:1KiB", "Did you mean page-size?"},
    {"study sweep balls-1 --vary=nodes", "expected nodes:VALUE,VALUE,..."},
    {"study sweep balls-1 --vary=nodes:", "--vary=nodes:: a value is missing"},
    {"study sweep balls-1 --vary=nodes:1,|background:0,0,0;;1,1,1", "a value is missing"},
    {"study sweep balls-1 --vary=:1", "an option's name is missing"},
    {"study sweep balls-1 --vary=nodes:2,2", "2 is there twice"},
    {"study sweep balls-1 --vary=count-pages:yes", "expected on, off or on,off"},
    {"study sweep balls-1 --vary=output:x|stats:x|trace:x|quiet:x|checkpoint:x|help:x|serve:x", "--vary"},
    {"bench precision --resolution=20", "--resolution"},
    {"bench precision --depth=0", "--depth={}: expected"},
    {"bench precision --expect=101|-1|most|99%",
     "--expect={}: expected a percentage from 0 to 100, such as 99.5\nTry: dmpc bench precision --help"},
    {"bench stability --rays=0", "--rays={}: expected"},
    {"bench stability --tests=R13|R99|", "--tests"},
    {"bench stability --tests=R1,", "--tests={}: a word is missing"},
    {"bench speed --parts=speed|kernels|kernel,~build|,|", "--parts"},
    {"bench speed --threads=0|1025|1.5|two|1,|-1|", "--threads"},
    {"bench speed --repeat=0", "--repeat={}: expected"},
    {"bench speed --resolution=16", "--resolution"},
    {"bench speed --format=xml", "--format"},
    {"bench error", "SCENE"},
    {"bench error tetra-2 --knobs=sample", "--knobs"},
    {"bench error tetra-2 --knobs=tessellation", "--knobs=tessellation"},
    {"bench error rings-2-t1 --knobs=tessellation", "--knobs=tessellation"},
    {"bench error tetra-2 --reference-samples=7|0", "--reference-samples"},
    {"bench error tetra-2 --samples=1|auto", "--samples"},
    {"bench error tetra-2 --repeat=0", "--repeat={}: expected"},
    {"bench error tetra-2 tetra-2", "tetra-2"},
    {"bench error balls-1 --transport=paths --reference-samples=12", "expected a power of two"},
};

/// Options that do not go with others, or want others, and what is no option, command or help.
const Refusal pairs[] = {
    {"render --error=0.01", "--error goes with --samples=auto"},
    {"render --samples=2 --samples-max=9", "--samples-max goes with --samples=auto"},
    {"render --time=3", "--time goes with --samples=auto"},
    {"render --passes=3", "--passes goes with --samples=auto"},
    {"paths --samples=auto --passes=1", "--passes={}: by paths expected at least 2"},
    {"render --voxels=article", "--voxels does not go with --structure=grid"},
    {"render --strategy=forest --structure=voxels|grid", "--structure={} does not go with --strategy=forest"},
    {"render --strategy=forest --record-order=scattered", "--record-order=scattered does not go with"},
    {"render --homes=tree --resident=101", "--resident"},
    {"dataflow --balance=moving", "at least 2 units per node"},
    {"dataflow --balance=moving --regions=1", "at least 2 units per node"},
    {"dataflow --regions=4", "--regions goes with"},
    {"dataflow --balance=scattered --cuts=alternating",
     "--cuts does not go with --balance=scattered: a lattice is not cut box by box"},
    {"render --strategy=replicated --cache-pages=5", "--cache-pages goes with --strategy=svm: "},
    {"render --replacement=python:/a.py:A|/a.so|./a.so", "--replacement={} goes with --runner=virtual: threads would wait"},
    {"render --runner=pool --replacement=/a.so", "--replacement=/a.so goes with --runner=virtual: "},
    {"render --runner=mpi --replacement=/a.so", "--replacement=/a.so goes with --runner=virtual: "},
    {"virtual --replacement=a.so|python",
     "--replacement={}: expected lru, clock, fifo, random, 2q, arc or s3-fifo or FILE.so|python:FILE.py:CLASS"},
    {"virtual --strategy=forest --replacement=/a.so", "--replacement goes with --strategy=svm: "},
    {"view teapot-12 --replacement=/a.so", "--replacement=/a.so goes with --runner=virtual: "},
    {"render --strategy=replicated --replacement=fifo", "--replacement goes with --strategy=svm: "},
    {"render --strategy=replicated --count-pages --stats=s.json", "--count-pages goes with --strategy=svm: "},
    {"render --strategy=replicated --cuts=alternating", "--cuts goes with --strategy=dataflow: "},
    {"render --strategy=replicated --ray-batch=10", "--ray-batch goes with --strategy=dataflow: "},
    {"render --strategy=replicated --ray-queue=512", "--ray-queue goes with --strategy=dataflow: "},
    {"render --strategy=replicated --homes=host", "--homes goes with --strategy=svm: "},
    {"dataflow --replacement=lru", "--replacement goes with --strategy=svm: "},
    {"dataflow --cache-pages=5", "--cache-pages goes with --strategy=svm: "},
    {"dataflow --count-pages --stats=s.json", "--count-pages goes with --strategy=svm: "},
    {"dataflow --homes=spread", "--homes goes with --strategy=svm: "},
    {"dataflow --in-flight=16", "--in-flight goes with --strategy=svm or --strategy=replicated or --strategy=forest: "},
    {"dataflow --work-item=3", "--work-item goes with --strategy=svm or --strategy=replicated or --strategy=forest: "},
    {"dataflow --work-donor=host", "--work-donor goes with --strategy=svm or --strategy=replicated or --strategy=forest: "},
    {"dataflow --pixels=interleaved", "--pixels goes with --strategy=svm or --strategy=replicated or --strategy=forest: "},
    {"render --strategy=forest --cache-pages=5", "--cache-pages goes with --strategy=svm: "},
    {"render --strategy=forest --ray-batch=5", "--ray-batch goes with --strategy=dataflow: "},
    {"render --strategy=forest --homes=host", "--homes goes with --strategy=svm: "},
    {"render --strategy=forest --resident=50", "--resident goes with --strategy=svm: "},
    {"render --balance=subsampled", "--balance goes with --strategy=dataflow: "},
    {"render --ray-credits=4", "--ray-credits goes with --strategy=dataflow: "},
    {"render --ray-slots=4", "--ray-slots goes with --strategy=dataflow: "},
    {"render --tested-objects=4", "--tested-objects goes with --strategy=dataflow: "},
    {"render --no-backpressure", "--no-backpressure goes with --strategy=dataflow: "},
    {"render --strategy=replicated --ray-queue=5 --tested-objects=2", "--ray-queue goes with"},  // the first of them in help
    {"render --ray-queue=5 --no-backpressure", "--ray-queue goes with"},
    {"dataflow --in-flight=2 --cache-pages=3", "--cache-pages goes with"},
    {"render --system=svm --structure=extents", "--structure=extents does not go with --system=svm"},
    {"render --system=pixel-machine --structure=voxels|grid", "--structure={} does not go with --system=pixel-machine"},
    {"render --system=pixel-machine --strategy=replicated",
     "--strategy=replicated does not go with --system=pixel-machine, which is --strategy=svm --structure=extents"},
    {"render --system=pixel-machine --pixels=submaps",
     "--pixels=submaps does not go with --system=pixel-machine, which is --strategy=svm --structure=extents"},
    {"render --system=pixel-machine --work-item=3", "--work-item=3 does not go with --system=pixel-machine, which is"},
    {"render --system=pixel-machine --homes=spread", "--homes=spread does not go with --system=pixel-machine, which is"},
    {"render --system=subsampled --balance=equal-size", "--balance=equal-size does not go with"},
    {"render --system=forest --homes=host", "--homes goes with --strategy=svm"},
    {"render --system=pixel-machine --work-donor=ring --ray-batch=5", "--ray-batch goes with"},
    {"render --pool-threads=2", "--pool-threads does not go with --runner=threads: each node has a thread of its own"},
    {"virtual --pool-threads=2", "--pool-threads does not go with --runner=virtual: a model has no threads"},
    {"render --runner=pool --machine=hdr", "--machine does not go with --runner=pool: threads model no machine"},
    {"render --machine=ipsc2", "--machine does not go with --runner=threads: threads model no "},
    {"render --strategy=replicated --machine=ipsc2", "--machine does not go with --runner=threads: threads model no "},
    {"dataflow --machine=ipsc2", "--machine does not go with --runner=threads: threads model no "},
    {"virtual --chaos=1", "--chaos does not go with --runner=virtual: "},
    {"virtual --strategy=replicated --tracer=embree", "--tracer=embree does not go with --runner=virtual"},
    {"render --tracer=embree", "needs --strategy=replicated"},
    {"dataflow --tracer=embree", "needs --strategy=replicated"},
    {"render --count-pages", "give --stats=FILE.json too"},
    {"render --references=a.csv --strategy=replicated|dataflow|forest", "--references needs --strategy=svm: with --strategy={}"},
    {"render --references=a.csv --count-pages --stats=a.json", "--references does not go with --count-pages"},
    {"render --references=a.csv --heatmap=pages:a.png", "--references does not go with --heatmap=pages"},
    {"render --references=a.csv --checkpoint=a --resume", "--resume does not go with --references"},
    {"dataflow --heatmap=faults:a.png|references:a.png|pages:a.png", "rays travel"},
    {"render --strategy=replicated --heatmap=faults:a.png|references:a.png|pages:a.png", "every node holds the whole scene"},
    {"render --trace-window=0,1", "give --trace=FILE"},
    {"render --resume", "goes with --checkpoint=FILE"},
    {"render --checkpoint-every=3", "goes with --checkpoint=FILE"},
    {"render --aov=albedo,normal", "give -o FILE.exr"},
    {"render --clamp=2", "--clamp goes with --transport=paths"},
    {"render --checkpoint=a --resume --heatmap=rays:b.png", "--resume does not go with --heatmap"},
    {"virtual --checkpoint=a", "--checkpoint does not go with --runner=virtual"},
    {"mesh --sky=1 --background=1", "--background does not go with --sky"},
    {"mesh --depth=3", "the default of a mesh unless --transport=whitted is given: use --bounces"},
    {"mesh --cutoff=0.1", "the default of a mesh unless --transport=whitted is given: paths that contribute little"},
    {"mesh --background=1", "nor with the default sky of a mesh without other light"},
    {"mesh --sky=1 --light=1,2,3", "only if --light is not given: give --transport=paths"},
    {"mesh --sky=1 --transport=whitted", "--sky goes with --transport=paths"},
    {"render --bounces=3", "--bounces goes with --transport=paths"},
    {"render --sky=1", "--sky goes with --transport=paths"},
    {"render --sky=a.hdr --background=0.5", "--background does not go with --sky"},
    {"paths --depth=3", "--depth does not go with --transport=paths: use --bounces"},
    {"paths --cutoff=0.1", "--cutoff does not go with --transport=paths: paths that contribute little"},
    {"paths --ambient=0.1", "--ambient does not go with --transport=paths: light from everywhere is a sky"},
    {"paths --sky=1 --background=0.5", "--background does not go with --sky"},
    {"render --instances=keep --system=svm", "--instances=keep does not go with --system=svm: "},
    {"render --instances=keep --structure=grid|voxels", "--instances=keep does not go with --structure={}: "},
    {"render --instances=keep --structure=grid|voxels", "; --instances=expand makes a copy for each instance"},
    {"render --instances=keep --record-order=scattered", "--instances=keep does not go with --record-order=scattered: "},
    {"render --instances=keep --strategy=replicated --tracer=embree", "--instances=keep does not go with --tracer=embree: "},
    {"dataflow --instances=keep --tested-objects=2", "--instances=keep does not go with --tested-objects: "},
    {"check grove-2 --instances=keep --structure=grid|voxels", "--instances=keep does not go with --structure={}: "},
    {"check grove-2 --instances=keep --record-order=scattered", "--instances=keep does not go with --record-order=scattered: "},
    {"info grove-2 --instances=keep --structure=grid", "--instances=keep does not go with --structure=grid: "},
    {"info balls-1 --system=pixel-machine --structure=grid", "--structure=grid does not go with --system=pixel-machine"},
    {"info balls-1 --system=pixel-machine --homes=spread", "--homes=spread does not go with --system=pixel-machine"},
    {"study systems grove-2 --instances=keep", "--instances is no option of dmpc study systems, but of "},
    {"study traffic grove-2 --instances=keep", "--instances is no option of dmpc study traffic, but of "},
    {"study frames grove-2 --instances=keep", "--instances is no option of dmpc study frames, but of "},
    {"bench speed grove-2 --instances=keep", "--instances is no option of dmpc bench speed, but of "},
    {"bench precision grove-2 --instances=keep", "--instances is no option of dmpc bench precision, but of "},
    {"study balance teapot-12 --bounces=3", "goes with --transport=paths"},
    {"study traffic teapot-12 --bounces=3", "goes with --transport=paths"},
    {"study cache teapot-12 --bounces=3", "goes with --transport=paths"},
    {"study speedup teapot-12 --bounces=3", "goes with --transport=paths"},
    {"study systems teapot-12 --bounces=3", "goes with --transport=paths"},
    {"study systems teapot-12 --structure=extents", "--structure is no option of dmpc study systems, but of "},
    {"study systems teapot-12 --report=a.html", "-o FILE has its table"},
    {"study frames teapot-12 --machine=hdr --machines=hdr,cm5", "--machines does not go"},
    {"study speedup teapot-12 --strategy=dataflow --cache-pages=5", "--cache-pages goes with --strategy=svm: "},
    {"study speedup teapot-12 --strategy=replicated --replacement=lru", "--replacement goes with --strategy=svm: "},
    {"study speedup teapot-12 --strategy=dataflow --in-flight=5",
     "--in-flight goes with --strategy=svm or --strategy=replicated or"},
    {"study speedup teapot-12 --ray-batch=5", "--ray-batch goes with --strategy=dataflow: "},
    {"study speedup teapot-12 --runner=virtual", "--runner"},
    {"study traffic teapot-12 --per-node", "dmpc study traffic --help"},
    {"study balance", "SCENE"},
    {"study", "Try: dmpc study --help"},
    {"study weather teapot-12",
     "expected balance, traffic, cache, speedup, systems, frames, paper, decades, references or sweep"},
    {"bench stability --quick --long", "--long"},
    {"bench stability --quick --rays=7", "--rays"},
    {"bench speed --ablation --parts=kernel", "--parts"},
    {"bench speed --ablation --threads=1", "--threads"},
    {"bench error balls-1 --transport=paths --knobs=cutoff", "--knobs=cutoff does not go with --transport=paths"},
    {"bench error balls-1 --knobs=bounces", "--knobs=bounces goes with"},
    {"compare a.exr b.json", "expected two pictures, two files of counters"},
    {"compare a.html b.json", "or two pages of renders, which end in .html"},
    {"compare a.html b.html --flip=f.png", "--flip goes with pictures"},
    {"compare a.exr b.exr --report=ab.html", "for pictures --difference and --flip show"},
    {"compare a.json b.json --report=ab.html", "alone cannot be played"},
    {"compare a.json b.json --fail-above=max:1", "--fail-above goes with pictures"},
    {"compare a.json b.json --flip=f.png", "--flip goes with pictures"},
    {"compare a.exr b.exr --only=rays", "--only goes with counters"},
    {"compare a.exr b.exr --tolerance=rays:1", "--tolerance goes with counters"},
    {"compare a.exr b.exr --nodes=4", "--nodes is no option of dmpc compare, but of dmpc render"},
    {"compare a.exr", "Try: dmpc compare --help"},
    {"list machines --pictures=a", "dmpc list --pictures=a"},
    {"machine", "Try: dmpc machine --help"},
    {"help render x y", "there is no help about 'x' of render: expected dmpc help render"},
    {"help study cache x", "'x' of study cache"},
    {"help glossary page", "there is no help about 'page' of glossary"},
    {"help study x", "x is no command"},
    {"draw", "draw is no command"},
    {"render --page=4", "--page is no option of dmpc render"},
    {"render --unheard-of=1", "--unheard-of"},
    {"scene", "SCENE"},
};

std::string with(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

/// The line of a row, with all that it leaves out.
std::string whole_line(const std::string& line) {
  for (const Refusal& beginning : beginnings) {
    if (line.starts_with(beginning.line + std::string(" "))) {
      return with(line, beginning.line, beginning.complaint);
    }
  }
  return line;
}

void check_refused(const Words& line, const std::string& expected) {
  const std::string complaint = usage_complaint(line);
  CAPTURE(line.back());
  CHECK_MESSAGE(contains(complaint, expected), complaint);
  CHECK_MESSAGE((contains(complaint, "\nTry: dmpc") && complaint.ends_with("--help")), complaint);
}

void check_refused(const Refusal& row) {
  Words line = apps::words_between(whole_line(row.line), ' ');
  const std::string last = line.back(), option = last.substr(0, last.find('=') + 1);
  CAPTURE(row.line);
  for (std::string value : apps::words_between(last.substr(option.size()), '|')) {
    std::replace(value.begin(), value.end(), '~', ' ');
    line.back() = option + value;
    check_refused(line, with(row.complaint, "{}", value));
  }
}

}  // namespace

TEST_CASE("a value that an option does not take is named, with what it takes and where that is said") {
  for (const Refusal& row : values) {
    check_refused(row);
  }
}

TEST_CASE("what does not go together, or is nothing that there is, is named, with the reason or what there is") {
  for (const Refusal& row : pairs) {
    check_refused(row);
  }
  CHECK(contains(usage_complaint({"render", "teapot-12"}), "Try: dmpc render --help"));
  CHECK(contains(usage_complaint({"render", "-o", "a.png"}), "SCENE"));
}

}  // namespace dmpc::tests::refusals_test

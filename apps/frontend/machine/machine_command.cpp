#include "apps/frontend/machine/machine_command.h"

#include <ostream>

#include "apps/frontend/machine/drawn_machine.h"
#include "apps/frontend/machine/machine_file.h"
#include "apps/frontend/system/output_file.h"
#include "apps/frontend/system/python_program.h"
#include "core/base/expect.h"

namespace dmpc::apps {

void add_options(OptionSet options, MachineOptions& machine) {
  options.add_argument(
      "MACHINE", [&machine](const std::string& text) { machine.machine = text; },
      "One of " + machine_preset_names() + ", or a machine file to check");
  options.add_number("--draw", machine.draw, 0, draw_max, "none",
                     "The machine of a draw of its prices, each within the certainty of its source, as study systems and study "
                     "decades draw them");
  options.add_flag(
      "--measure", machine.is_measured,
      "With prices that are measured on this computer, by renders of two processes over MPI on the loopback, with their "
      "spread as certainty. Needs Python with numpy, pandas and OpenImageIO");
  options.check_in_the_end([&machine, options] {
    if (machine.is_measured && options.is_given("--draw")) {
      throw core::UsageError("--draw does not go with --measure");
    }
  });
  options.set_examples(
      "Examples:\n"
      "  dmpc machine ipsc2 > mine.json\n"
      "  dmpc render teapot-12 --runner=virtual --machine=mine.json -o teapot.png\n"
      "  dmpc machine hdr --measure > this.json\n"
      "Times of a message: send_ns occupies the sender's processor, then latency_ns passes, then the message takes hop_ns for\n"
      "each link and byte_ps for each byte of header and payload, and receive_ns occupies the receiver's processor. A page\n"
      "request interrupts its target for receive_ns, service_ns and the reply's send_ns. operation_ps is the time of a node for\n"
      "each operation of a class. switching is what a message occupies: circuit all links of its route until it has arrived,\n"
      "packet each link for its own bytes. uplinks are those of a switch of a fat tree. has_contention: a link carries one\n"
      "message at a time. has_memory_port: so does a node's memory, one in and one out, over all links; it requires\n"
      "has_contention, and is off in all machines here, since there is no published figure. Sources say where a figure comes\n"
      "from and how certain it is: high, medium or low. Quoted figures are commonly given, but their measurements were not\n"
      "looked up; fitted ones were chosen so that the model gives a printed time; assumed ones have no source. Sources may be\n"
      "left out, and so may prices_for, the structures that operation_ps was measured with or fitted to: who renders on another\n"
      "one is told so.");
}

int machine_command(const MachineOptions& options, std::ostream& output) {
  if (options.is_measured) {
    become_python("decades.measuring", "machine --measure", {options.machine});
  }
  MachineDescription machine = load_machine(options.machine);
  if (options.draw) {
    machine.machine = drawn(machine, *options.draw);
  }
  output << machine_text(machine);
  finish_output(output, "the machine");
  return 0;
}

}  // namespace dmpc::apps

#include "tests/oracle/simulated_network.h"

#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <iostream>
#include <map>
#include <simgrid/s4u.hpp>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "nodes/topology.h"

namespace dmpc::tests {
namespace {

namespace s4u = simgrid::s4u;

constexpr double seconds_per_ns = 1e-9;

class Simulation {
 public:
  Simulation(const nodes::Machine& machine, std::uint32_t node_count, const std::vector<TimedMessage>& messages)
      : machine_(machine),
        topology_(machine.topology, node_count, machine.uplinks),
        messages_(messages),
        arrivals_ns_(messages.size()) {}

  std::vector<double> run() {
    int argument_count = 2;
    std::array<char*, 3> arguments{program_.data(), quiet_.data(), nullptr};
    s4u::Engine engine(&argument_count, arguments.data());
    auto* const zone = s4u::create_full_zone("network");
    host_ = zone->create_host("clock", 1e9);
    zone->seal();
    for (std::size_t i = 0; i < messages_.size(); ++i) {
      s4u::Actor::create("message", host_, [this, i] { travel(i); });
    }
    engine.run();
    return arrivals_ns_;
  }

 private:
  void travel(std::size_t i) {
    const TimedMessage& message = messages_[i];
    std::vector<nodes::Link> route;
    topology_.append_route(message.source, message.target, route);
    const double hop = seconds_per_ns * static_cast<double>(machine_.hop_ns);
    const double bytes =
        seconds_per_ns * static_cast<double>(message.bytes * machine_.cost_of_message(message.bytes).byte_ps / 1000);
    s4u::this_actor::sleep_until(seconds_per_ns * static_cast<double>(message.enters_ns));
    for (const nodes::Link& link : route) {
      take(link);
      if (machine_.switching == nodes::Switching::packet) {
        give_back_after(link, hop + bytes);
      }
      s4u::this_actor::sleep_for(hop);
    }
    s4u::this_actor::sleep_for(bytes);
    arrivals_ns_[i] = s4u::Engine::get_clock() / seconds_per_ns;
    for (std::size_t held = 0; held < route.size() && machine_.switching == nodes::Switching::circuit; ++held) {
      semaphore(route[held])->release();
    }
  }

  void take(const nodes::Link& link) { semaphore(link)->acquire(); }

  void give_back_after(const nodes::Link& link, double seconds) {
    s4u::Actor::create("tail", host_, [taken = semaphore(link), seconds] {
      s4u::this_actor::sleep_for(seconds);
      taken->release();
    });
  }

  s4u::SemaphorePtr semaphore(const nodes::Link& link) {
    s4u::SemaphorePtr& semaphore = semaphores_[{link.from, link.to}];
    if (!semaphore) {
      semaphore = s4u::Semaphore::create(1);
    }
    return semaphore;
  }

  const nodes::Machine& machine_;
  nodes::Topology topology_;
  const std::vector<TimedMessage>& messages_;
  std::vector<double> arrivals_ns_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, s4u::SemaphorePtr> semaphores_;
  s4u::Host* host_ = nullptr;
  std::string program_ = "network", quiet_ = "--log=root.thresh:error";
};

/// All of them, or fewer if the writer has ended before.
std::vector<double> read_doubles(int from, std::size_t count) {
  std::vector<double> numbers(count);
  auto* const bytes = reinterpret_cast<char*>(numbers.data());
  std::size_t done = 0;
  for (ssize_t step = 1; step > 0 && done<count * sizeof(double); done += step> 0 ? static_cast<std::size_t>(step) : 0) {
    step = ::read(from, bytes + done, count * sizeof(double) - done);
  }
  numbers.resize(done / sizeof(double));
  return numbers;
}

void write_doubles(int to, const std::vector<double>& numbers) {
  const auto* const bytes = reinterpret_cast<const char*>(numbers.data());
  std::size_t done = 0;
  while (done < numbers.size() * sizeof(double)) {
    const ssize_t step = ::write(to, bytes + done, numbers.size() * sizeof(double) - done);
    if (step <= 0) {
      return;
    }
    done += static_cast<std::size_t>(step);
  }
}

}  // namespace

std::vector<double> arrivals_by_simgrid(const nodes::Machine& machine, std::uint32_t node_count,
                                        const std::vector<TimedMessage>& messages) {
  std::array<int, 2> ends{};
  if (::pipe(ends.data()) != 0) {
    throw std::runtime_error("no pipe to a simulation");
  }
  std::cout.flush();  // or both processes write what is in it
  std::fflush(stdout);
  const pid_t child = ::fork();
  if (child == 0) {
    ::close(ends[0]);
    write_doubles(ends[1], Simulation(machine, node_count, messages).run());
    ::_exit(0);
  }
  ::close(ends[1]);
  std::vector<double> arrivals_ns = child < 0 ? std::vector<double>() : read_doubles(ends[0], messages.size());
  ::close(ends[0]);
  int status = 0;
  ::waitpid(child, &status, 0);
  if (arrivals_ns.size() != messages.size()) {
    throw std::runtime_error("the simulation by SimGrid has come to no end");
  }
  return arrivals_ns;
}

}  // namespace dmpc::tests

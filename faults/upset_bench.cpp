// SPDX-License-Identifier: Apache-2.0
// A core, a careful driver in front of it, and one flipped bit a trial. frames.py and trials.py write the plan that it reads.
//
// The fault-free run comes once; at the clock of each trial the process forks, and the child flips its bit and goes on alone.
// A child whose flip-flops, and everything that its driver has seen, are again those of the fault-free run ends there: nothing can follow.
//
// The bit changes after the rising edge of the clock before, and what hangs on it settles before the next one: as an upset between two
// edges does. The model is that of Verilator, compiled as Vcore; flip-flops are found by the names that it keeps for VPI.
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iostream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "Vcore.h"
#include "Vcore___024root.h"
#include "verilated.h"
#include "verilated_syms.h"

// Combinational logic from the flip-flops as they are; Verilator calls it once, at the start.
void Vcore___024root___eval_settle(Vcore___024root* root);

namespace {

struct Register {
  uint32_t address;
  uint32_t word;  // of the configuration; of a result, 1: a diagnostic number
};
struct Frame {
  bool push;
  unsigned gap;  // clocks between two beats of the stream
  std::vector<uint64_t> beats;
};
struct Trial {
  uint64_t id, clock;  // clocks from where frame 1's first beat is offered
  uint8_t* place;
  uint8_t mask;
};

enum End { DONE, FLAGGED, BOUND, REFUSED, NOT_RUN };

// What the driver saw of a frame.
struct Seen {
  End end = NOT_RUN;
  uint32_t flags = 0;     // FLAGS and FRAME_FLAGS, all that were read
  bool error = false;     // SLVERR
  bool differs = false;   // two reads of a result, or of the configuration
  bool bus_dead = false;  // no answer
  bool stray = false;     // an answer to no request
  bool interrupt = false; // irq low after the frame, or high after its acknowledgement
  uint32_t clocks = 0;
  std::vector<uint32_t> words;
  bool noticed() const { return flags || error || differs || bus_dead || end == BOUND || end == REFUSED; }
};

std::map<std::string, uint32_t> number;
std::vector<Register> configuration, results;
std::vector<Frame> frames;
std::vector<Trial> trials;

Vcore* core;
uint64_t now = 0, history = 0xcbf29ce484222325ull;
bool recording = true, child = false;
// clocks of frame 1: begun, last beat taken, end seen, results read
uint64_t window_first = 0, window_loaded = 0, window_end = 0, window_read = 0;

// the fault-free run
constexpr uint64_t EVERY = 16;
std::vector<uint64_t> histories;
std::vector<std::vector<uint8_t>> states;
std::vector<Seen> wanted;

// ---- clock and stream

const Frame* streaming = nullptr;
size_t sent = 0;
unsigned pause_left = 0;
bool error_seen = false, dead_seen = false, stray_seen = false;
bool read_open = false, write_open = false;
struct {
  bool awready, wready, bvalid, arready, rvalid, error;
  uint32_t rdata;
} edge;  // what the rising edge saw
size_t next_trial = 0;
uint64_t trial_id = 0;

void note(uint64_t word) { history = (history ^ word) * 0x100000001b3ull; }

const uint8_t* state_bytes() { return reinterpret_cast<const uint8_t*>(core->rootp); }

void branch() {
  while (!child && !recording && next_trial < trials.size() && trials[next_trial].clock == now) {
    const Trial& one = trials[next_trial++];
    const pid_t pid = fork();
    if (pid < 0) { perror("fork"); exit(2); }
    if (pid == 0) {
      child = true;
      trial_id = one.id;
      core->clk = 0;
      core->eval();
      *one.place ^= one.mask;
      const uint8_t flipped = *one.place;
      Vcore___024root___eval_settle(core->rootp);
      if (*one.place != flipped) {
        printf("%llu COPY\n", static_cast<unsigned long long>(trial_id));
        fflush(stdout);
        _exit(0);
      }
      return;
    }
    int status = 0;
    waitpid(pid, &status, 0);
    if (status != 0) printf("%llu CRASH %d\n", static_cast<unsigned long long>(one.id), status);
  }
}

void tick() {
  core->s_axis_tvalid = 0;
  if (streaming && sent < streaming->beats.size() && pause_left == 0) {
    core->s_axis_tvalid = 1;
    core->s_axis_tdata = streaming->beats[sent];
    core->s_axis_tlast = sent + 1 == streaming->beats.size();
  }
  branch();
  core->clk = 0;
  core->eval();
  note(core->s_axis_tready | core->s_axil_awready << 1 | core->s_axil_wready << 2 | core->s_axil_bvalid << 3 |
       core->s_axil_arready << 4 | core->s_axil_rvalid << 5 | core->irq << 6 | core->s_axil_bresp << 8 | core->s_axil_rresp << 10);
  if (core->s_axil_rvalid) note(core->s_axil_rdata);
  if ((core->s_axil_rvalid && !read_open) || (core->s_axil_bvalid && !write_open)) stray_seen = true;
  edge = {bool(core->s_axil_awready), bool(core->s_axil_wready), bool(core->s_axil_bvalid), bool(core->s_axil_arready),
          bool(core->s_axil_rvalid),  bool(write_open ? core->s_axil_bresp : core->s_axil_rresp), core->s_axil_rdata};
  const bool taken = core->s_axis_tvalid && core->s_axis_tready;
  core->clk = 1;
  core->eval();
  if (pause_left) pause_left--;
  if (taken) {
    sent++;
    pause_left = streaming->gap;
    if (sent == streaming->beats.size() && streaming == &frames[1]) window_loaded = now;
  }
  now++;
  if (now % EVERY == 0) {
    if (recording) {
      histories.push_back(history);
      states.emplace_back(state_bytes(), state_bytes() + sizeof(*core->rootp));
    } else if (child) {
      const size_t at = now / EVERY - 1;
      if (!number["whole"] && at < states.size() && histories[at] == history && !memcmp(states[at].data(), state_bytes(), states[at].size())) {
        printf("%llu SAME %llu\n", static_cast<unsigned long long>(trial_id), static_cast<unsigned long long>(now));
        fflush(stdout);
        _exit(0);
      }
    }
  }
}

// ---- bus: one access at a time

uint32_t read_word(uint32_t address) {
  const uint64_t until = now + number["patience"];
  core->s_axil_araddr = address;
  core->s_axil_arvalid = 1;
  read_open = true;
  bool answered = false;
  while (!answered && now < until) {
    tick();
    answered = core->s_axil_rready && edge.rvalid;
    if (core->s_axil_arvalid && edge.arready) {
      core->s_axil_arvalid = 0;
      core->s_axil_rready = 1;
    }
  }
  core->s_axil_arvalid = core->s_axil_rready = 0;
  read_open = false;
  dead_seen |= !answered;
  error_seen |= answered && edge.error;
  return answered ? edge.rdata : 0;
}

void write_word(uint32_t address, uint32_t data) {
  const uint64_t until = now + number["patience"];
  core->s_axil_awaddr = address;
  core->s_axil_wdata = data;
  core->s_axil_wstrb = 15;
  core->s_axil_awvalid = core->s_axil_wvalid = 1;
  write_open = true;
  bool answered = false;
  while (!answered && now < until) {
    tick();
    answered = core->s_axil_bready && edge.bvalid;
    if (edge.awready) core->s_axil_awvalid = 0;
    if (edge.wready) core->s_axil_wvalid = 0;
    if (!core->s_axil_awvalid && !core->s_axil_wvalid) core->s_axil_bready = 1;
  }
  core->s_axil_awvalid = core->s_axil_wvalid = core->s_axil_bready = 0;
  write_open = false;
  dead_seen |= !answered;
  error_seen |= answered && edge.error;
}

// ---- driver

bool configure() {
  for (const Register& one : configuration) write_word(one.address, one.word);
  bool right = true;
  for (const Register& one : configuration) right &= read_word(one.address) == one.word;
  return right;
}

void recover() {
  streaming = nullptr;
  write_word(number["control"], number["soft_reset"]);
  write_word(number["flags"], number["every_flag"]);
  write_word(number["irq_status"], 3);
}

// Feed, wait, read. A frame's SLVERR and silence of the bus count for it.
Seen run(const Frame& frame) {
  Seen seen;
  error_seen = dead_seen = stray_seen = false;
  const uint64_t start = now;
  write_word(number["flags"], number["every_flag"]);
  write_word(number["irq_status"], 3);
  const uint32_t before = read_word(number["status"]);
  const uint32_t frame_mask = number["frame_mask"], state_mask = number["state_mask"];
  if (frame.push && !(before & number["push_ready"])) seen.end = REFUSED;
  if (seen.end == NOT_RUN) {
    if (window_first == 0 && &frame == &frames[1]) window_first = now;
    if (frame.push) {
      for (size_t index = 0; index < frame.beats.size(); index++) {
        write_word(number["data_a"], static_cast<uint32_t>(frame.beats[index]));
        write_word(number["data_b"], static_cast<uint32_t>(frame.beats[index] >> 32));
        write_word(number["push"], index + 1 == frame.beats.size() ? number["push_last"] : 0);
      }
      if (&frame == &frames[1]) window_loaded = now;
    } else {
      streaming = &frame;
      sent = 0;
      pause_left = 0;
    }
    seen.end = BOUND;
    while (now - start < number["bound"] && !dead_seen) {
      const uint32_t flags = read_word(number["flags"]);
      const uint32_t status = read_word(number["status"]);
      seen.flags |= flags & number["every_flag"];
      if (flags & number["failures"]) {
        seen.end = FLAGGED;
        break;
      }
      // the state says that all is over, not only the number of frames, and says so twice
      if (((status ^ before) & frame_mask) && (status & state_mask) == number["state_done"] && (status & number["all_ready"]) &&
          read_word(number["status"]) == status) {
        seen.end = DONE;
        break;
      }
    }
    if (window_end == 0 && &frame == &frames[1]) window_end = now;
    streaming = nullptr;
  }
  seen.interrupt = seen.end == DONE && !core->irq;
  if (seen.end == DONE) {
    for (const Register& one : results) seen.words.push_back(read_word(one.address));
    for (size_t index = 0; index < results.size(); index++) seen.differs |= read_word(results[index].address) != seen.words[index];
  }
  if (window_read == 0 && &frame == &frames[1]) window_read = now;
  if (seen.end != REFUSED) seen.flags |= read_word(number["frame_flags"]) & number["every_flag"];
  seen.flags |= read_word(number["flags"]) & number["every_flag"];
  write_word(number["irq_status"], 3);
  tick();
  tick();
  seen.interrupt |= seen.end == DONE && core->irq;
  seen.error = error_seen;
  seen.bus_dead = dead_seen;
  seen.stray = stray_seen;
  seen.clocks = now - start;
  return seen;
}

void show(const Seen& seen, const Seen* right) {
  uint64_t wrong = 0, diagnostic = 0;
  if (right)
    for (size_t index = 0; index < seen.words.size(); index++)
      if (seen.words[index] != right->words[index]) (results[index].word ? diagnostic : wrong) |= 1ull << index;
  printf(" %d %x %d %d %d %d %d %u %llx %llx", seen.end, seen.flags, seen.error, seen.differs, seen.bus_dead, seen.stray, seen.interrupt,
         seen.clocks, static_cast<unsigned long long>(wrong), static_cast<unsigned long long>(diagnostic));
}

bool right(const Seen& seen, const Seen& good) { return seen.end == DONE && !seen.noticed() && seen.words == good.words; }

// Frame 0, so that nothing is as the reset left it; frame 1; what a driver does about it; frame 2, and once more where it was not right.
void episode() {
  core->rst = 1;
  for (int clock = 0; clock < 4; clock++) tick();
  core->rst = 0;
  tick();
  std::vector<Seen> seen;
  bool configured = configure();
  seen.push_back(run(frames[0]));
  configured &= configure();
  if (!configured) {
    printf("BAD the configuration does not read back\n");
    exit(2);
  }
  seen.push_back(run(frames[1]));
  for (int again = 0; again < 2; again++) {
    bool set = true;
    if (seen.back().noticed() || seen.back().end != DONE) {
      error_seen = dead_seen = stray_seen = false;
      recover();
      set = configure();
      if (!set) {  // once more
        recover();
        set = configure();
      }
    }
    Seen next = run(frames[2]);
    next.differs |= !set;
    seen.push_back(next);
    if (recording || (!wanted.empty() && right(next, wanted[2]))) break;
  }
  if (recording) {
    wanted = seen;
    return;
  }
  if (child) {
    printf("%llu RAN", static_cast<unsigned long long>(trial_id));
    for (size_t index = 1; index < seen.size(); index++) show(seen[index], &wanted[std::min<size_t>(index, 2)]);
    printf("\n");
    fflush(stdout);
    _exit(0);
  }
}

// ---- plan: lines of words, numbers in hexadecimal

void read_plan(const char* file) {
  std::ifstream in(file);
  std::string line, what;
  const VerilatedScopeNameMap* scopes = core->contextp()->scopeNameMap();
  while (std::getline(in, line)) {
    std::istringstream words(line);
    words >> what >> std::hex;
    if (what == "set") {
      std::string name;
      words >> name;
      words >> number[name];
    } else if (what == "configure" || what == "result") {
      Register one;
      words >> one.address >> one.word;
      (what == "result" ? results : configuration).push_back(one);
    } else if (what == "frame") {
      Frame one;
      words >> one.push >> one.gap;
      uint64_t beat;
      while (words >> beat) one.beats.push_back(beat);
      frames.push_back(one);
    } else if (what == "trial") {
      Trial one;
      std::string scope, name;
      int element;
      unsigned bit;
      words >> one.id >> one.clock >> scope >> name >> std::dec >> element >> bit;
      const auto found = scopes->find(("TOP." + scope).c_str());
      VerilatedVar* variable = found == scopes->end() ? nullptr : found->second->varFind(name.c_str());
      if (!variable) {
        std::cout << "BAD the simulator does not know " << scope << "." << name << std::endl;
        exit(2);
      }
      size_t offset = 0;
      if (element >= 0) offset = variable->entSize() * (element - std::min(variable->left(1), variable->right(1)));
      one.place = static_cast<uint8_t*>(variable->datap()) + offset + bit / 8;
      one.mask = 1u << (bit % 8);
      trials.push_back(one);
    }
  }
  std::stable_sort(trials.begin(), trials.end(), [](const Trial& a, const Trial& b) { return a.clock < b.clock; });
}

// Before the first clock.
void fresh() {
  now = 0;
  history = 0xcbf29ce484222325ull;
  streaming = nullptr;
  core->rst = 1;
  core->clk = 0;
  core->s_axil_awvalid = core->s_axil_wvalid = core->s_axil_bready = core->s_axil_arvalid = core->s_axil_rready = 0;
  core->s_axis_tvalid = core->s_axis_tlast = 0;
  core->eval();
}

}  // namespace

int main(int count, char** arguments) {
  setvbuf(stdout, nullptr, _IOFBF, 1 << 16);
  VerilatedContext* const context = new VerilatedContext;
  context->randReset(2);
  context->randSeed(1);
  core = new Vcore(context, "TOP");
  if (count != 2) return 2;
  core->eval();
  std::vector<uint8_t> start(state_bytes(), state_bytes() + sizeof(*core->rootp));
  read_plan(arguments[1]);
  fresh();
  episode();
  printf("WINDOW %llu %llu %llu\n", static_cast<unsigned long long>(window_loaded - window_first),
         static_cast<unsigned long long>(window_end - window_first),
         static_cast<unsigned long long>(window_read - window_first));
  for (const Seen& seen : wanted) {
    printf("FRAME");
    show(seen, nullptr);
    for (uint32_t word : seen.words) printf(" %x", word);
    printf("\n");
  }
  fflush(stdout);
  recording = false;
  for (Trial& one : trials) one.clock += window_first;
  // from the same start: every flip-flop as the first time
  memcpy(static_cast<void*>(core->rootp), start.data(), start.size());
  fresh();
  if (!trials.empty()) episode();
  printf("END\n");
  return 0;
}

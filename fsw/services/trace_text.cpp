// One JSON object an observation: X is a span, i a mark, C a counter, M a name.
#include "fsw/services/trace_text.hpp"

#include <algorithm>
#include <array>
#include <limits>

#include "fsw/services/event_text.hpp"
#include "fsw/services/json_text.hpp"

namespace omma {
namespace {

constexpr int kProcess = 1;
constexpr int kEventTrack = 0;  // groups follow from 1

std::string_view reaction_name(std::uint32_t reaction) {
  static constexpr std::array<std::string_view, 4> kNames{"none", "degrade", "skip", "safe"};
  return reaction < kNames.size() ? kNames[reaction] : "unknown";
}

/// Collects the trace's parts; instants in microseconds on the machine's monotonic clock.
class Drawing {
 public:
  Drawing() { json_.open_object().key("displayTimeUnit").string("ns").key("traceEvents").open_array(); }

  void name_process(std::string_view name) { name_of("process_name", kEventTrack, name); }
  void name_track(int track, std::string_view name) {
    name_of("thread_name", track, name);
    begin("M", "thread_sort_index", track).key("args").open_object().key("sort_index").number(track);
    json_.close_object().close_object();
  }

  /// Each leaves the object's "args" open for the caller to fill.
  JsonText& span(std::string_view name, int track, TimeNs start_ns, TimeNs duration_ns) {
    begin("X", name, track).key("ts").number(microseconds(start_ns));
    json_.key("dur").number(microseconds(duration_ns)).key("args").open_object();
    return count(start_ns, start_ns + duration_ns);
  }
  JsonText& mark(std::string_view name, int track, TimeNs at_ns) {
    begin("i", name, track).key("ts").number(microseconds(at_ns)).key("s").string("t");
    json_.key("args").open_object();
    return count(at_ns, at_ns);
  }
  JsonText& counter(std::string_view name, int track, TimeNs at_ns) {
    begin("C", name, track).key("ts").number(microseconds(at_ns)).key("args").open_object();
    return count(at_ns, at_ns);
  }
  void end() { json_.close_object().close_object(); }

  TraceText take() {
    json_.close_array().close_object();
    return {json_.text(), records_, records_ > 0 ? newest_ns_ - oldest_ns_ : 0};
  }

 private:
  static double microseconds(TimeNs time) { return static_cast<double>(time) * 1e-3; }

  JsonText& begin(std::string_view phase, std::string_view name, int track) {
    json_.open_object().key("ph").string(phase).key("name").string(name);
    return json_.key("pid").number(kProcess).key("tid").number(track);
  }
  void name_of(std::string_view what, int track, std::string_view name) {
    begin("M", what, track).key("args").open_object().key("name").string(name);
    json_.close_object().close_object();
  }
  JsonText& count(TimeNs from_ns, TimeNs to_ns) {
    ++records_;
    oldest_ns_ = std::min(oldest_ns_, from_ns);
    newest_ns_ = std::max(newest_ns_, to_ns);
    return json_;
  }

  JsonText json_;
  std::size_t records_ = 0;
  TimeNs oldest_ns_ = std::numeric_limits<TimeNs>::max();
  TimeNs newest_ns_ = std::numeric_limits<TimeNs>::min();
};

void tick_argument(JsonText& arguments, const TraceRecord& record) {
  arguments.key("tick").number(static_cast<double>(record.tick));
}

/// From the oldest to the newest of now.
template <class Record, Writers kWriters, class Draw>
void draw_each(const HistoryRing<Record, kWriters>& ring, Draw&& draw_one) {
  const std::uint64_t end = ring.written();
  Record record;
  for (std::uint64_t number = ring.oldest(); number < end; ++number)
    if (ring.read(number, record)) draw_one(record);
}

void draw(const TraceRecord& record, const FlightRecorder::Group& group, int track, Drawing& drawing) {
  if (record.position() >= group.components.size()) return;
  const std::string& component = group.components[record.position()];
  switch (record.kind()) {
    case TraceKind::kBeat:
      drawing.counter("lateness of " + group.name + " [us]", track, record.start_ns + record.duration_ns)
          .key("us")
          .number(static_cast<double>(record.duration_ns) * 1e-3);
      break;
    case TraceKind::kStep: {
      JsonText& arguments = drawing.span(component, track, record.start_ns, record.duration_ns);
      tick_argument(arguments, record);
      arguments.key("left_processor").boolean(record.value() != 0);
      break;
    }
    case TraceKind::kMissed: {
      JsonText& arguments = drawing.mark("missed beats", track, record.start_ns);
      tick_argument(arguments, record);
      arguments.key("count").number(record.value());
      break;
    }
    case TraceKind::kBreach: {
      JsonText& arguments = drawing.mark("over budget: " + component, track, record.start_ns);
      tick_argument(arguments, record);
      arguments.key("budget_us").number(static_cast<double>(record.duration_ns) * 1e-3);
      break;
    }
    case TraceKind::kReaction: {
      JsonText& arguments = drawing.mark("budget reaction: " + component, track, record.start_ns);
      tick_argument(arguments, record);
      arguments.key("reaction").string(reaction_name(record.value()));
      break;
    }
    case TraceKind::kRecovered: {
      JsonText& arguments = drawing.mark("budget kept again: " + component, track, record.start_ns);
      tick_argument(arguments, record);
      arguments.key("level").number(record.value());
      break;
    }
    case TraceKind::kJob:
      return;  // on the workers' tracks
  }
  drawing.end();
}

void draw_job(const TraceRecord& record, int track, Drawing& drawing) {
  drawing.span("job", track, record.start_ns, record.duration_ns).key("job").number(record.value());
  drawing.end();
}

void draw(const EventMoment& moment, std::span<const EventDescriptor> descriptors, Drawing& drawing) {
  const EventDescriptor* const declared = find_event(descriptors, moment.record.id);
  JsonText& arguments = drawing.mark(event_name(declared, moment.record.id), kEventTrack, moment.stamp_ns);
  arguments.key("tick").number(static_cast<double>(moment.record.tick));
  arguments.key("severity").string(severity_name(moment.record.severity));
  if (declared != nullptr) arguments.key("text").string(event_text(*declared, moment.record));
  drawing.end();
}

}  // namespace

TraceText trace_text(const FlightRecorder& recorder, const Events& events,
                     std::span<const EventDescriptor> descriptors) {
  Drawing drawing;
  drawing.name_process("omma-fsw");
  drawing.name_track(kEventTrack, "events");
  int track = kEventTrack;
  for (const auto& group : recorder.groups()) {
    drawing.name_track(++track, group->name);
    draw_each(group->ring, [&](const TraceRecord& record) { draw(record, *group, track, drawing); });
  }
  for (std::size_t worker = 0; worker < recorder.workers().size(); ++worker) {
    drawing.name_track(++track,
                       worker == 0 ? "jobs of the caller" : "jobs of worker " + std::to_string(worker));
    draw_each(*recorder.workers()[worker],
              [&](const TraceRecord& record) { draw_job(record, track, drawing); });
  }
  draw_each(events.history(), [&](const EventMoment& moment) { draw(moment, descriptors, drawing); });
  return drawing.take();
}

}  // namespace omma

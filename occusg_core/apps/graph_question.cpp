// SPDX-License-Identifier: BSD-3-Clause
#include "graph_question.hpp"

#include <algorithm>
#include <cstddef>
#include <iomanip>
#include <ios>
#include <locale>
#include <optional>
#include <sstream>
#include <vector>

#include "command_line.hpp"
#include "io/graph_json.hpp"
#include "occusg/error.hpp"
#include "occusg/graph/graph_query.hpp"

namespace occusg::apps {
namespace {

/// The words of a question, taken one after the other.
class Words {
 public:
  explicit Words(const std::string& text) {
    std::istringstream stream(text);
    stream.imbue(std::locale::classic());
    for (std::string word; stream >> word;) words_.push_back(word);
  }

  [[nodiscard]] bool atEnd() const { return next_ == words_.size(); }
  [[nodiscard]] std::size_t left() const { return words_.size() - next_; }
  /// Whether "at" and the numbers of a place are all that is left, or nothing is.
  [[nodiscard]] bool atPlace() const {
    constexpr std::size_t kFewest = 3;
    constexpr std::size_t kMost = 4;
    return left() < kFewest || (left() <= kMost && words_[next_] == "at");
  }
  [[nodiscard]] std::optional<std::string> take() {
    if (atEnd()) return std::nullopt;
    return words_[next_++];
  }
  [[nodiscard]] bool takes(const std::string& expected) { return take() == expected; }

  template <typename Number>
  [[nodiscard]] std::optional<Number> takeNumber() {
    const std::optional<std::string> word = take();
    if (!word) return std::nullopt;
    std::istringstream stream(*word);
    stream.imbue(std::locale::classic());
    Number number{};
    if (!(stream >> number) || !(stream >> std::ws).eof()) return std::nullopt;
    return number;
  }

  /// Two numbers, or three where the next word is one too.
  [[nodiscard]] std::optional<Place> takePlace() {
    const auto x = takeNumber<double>();
    const auto y = takeNumber<double>();
    if (!x || !y) return std::nullopt;
    const std::size_t before_height = next_;
    if (const auto z = takeNumber<double>()) return Place{*x, *y, *z};
    next_ = before_height;
    return Place{*x, *y};
  }

  /// All words that are left: a number, an id, a name or a label.
  [[nodiscard]] std::optional<std::string> takeRoom() {
    std::string room;
    while (!atEnd()) room += (room.empty() ? "" : " ") + words_[next_++];
    if (room.empty()) return std::nullopt;
    return room;
  }

 private:
  std::vector<std::string> words_;
  std::size_t next_ = 0;
};

std::optional<GraphQuestion> way(Words& words) {
  const auto from = words.takePlace();
  const bool leads = words.takes("to");
  const auto to = words.takePlace();
  if (!from || !leads || !to) return std::nullopt;
  return WayQuestion{*from, *to};
}

std::optional<GraphQuestion> nearest(Words& words) {
  std::string class_name;
  while (!words.atPlace())
    class_name += (class_name.empty() ? "" : " ") + words.take().value_or("");
  const bool has_place = words.takes("at");
  const auto place = words.takePlace();
  if (class_name.empty() || !has_place || !place) return std::nullopt;
  return NearestQuestion{class_name, *place};
}

std::optional<GraphQuestion> understood(Words& words) {
  const std::string first = words.take().value_or("");
  if (first == "way") return way(words);
  if (first == "nearest") return nearest(words);
  const std::string second = words.take().value_or("");
  if (first == "room" && second == "at") {
    const auto place = words.takePlace();
    if (place) return RoomAtQuestion{*place};
  }
  if (first == "contents" && second == "of") {
    const auto room = words.takeRoom();
    if (room) return ContentsQuestion{*room};
  }
  if (first == "adjacent" && second == "to") {
    const auto room = words.takeRoom();
    if (room) return AdjacentQuestion{*room};
  }
  return std::nullopt;
}

class Answer {
 public:
  explicit Answer(const SceneGraph& graph) : graph_(graph) {
    text_.imbue(std::locale::classic());
    text_ << std::fixed << std::setprecision(2);
  }

  void operator()(const RoomAtQuestion& question) {
    const std::optional<NodeId> room = roomAt(graph_, question.place);
    if (room) {
      tellRoom(*room);
    } else {
      text_ << "none\n";
    }
  }

  void operator()(const WayQuestion& question) {
    const std::optional<Route> route = shortestRoute(graph_, question.from, question.to);
    if (!route) {
      text_ << "none\n";
      return;
    }
    text_ << route->length_m << " m\n";
    for (const NodeId room : route->rooms) tellRoom(room);
    for (const NodeId door : route->doors) tellDoor(door);
    for (const NodeId stairs : route->stairs) tellStairs(stairs);
  }

  void operator()(const ContentsQuestion& question) {
    const std::vector<NodeId> objects = objectsIn(graph_, roomNamed(graph_, question.room));
    for (const NodeId object : objects) tellObject(object);
    if (objects.empty()) text_ << "none\n";
  }

  void operator()(const NearestQuestion& question) {
    const auto object = nearestObject(graph_, question.class_name, question.place);
    if (!object) {
      text_ << "none\n";
      return;
    }
    tellObject(*object);
    text_ << distance(graph_.at(*object).groundPosition(), question.place.point) << " m away\n";
  }

  void operator()(const AdjacentQuestion& question) {
    const auto beside = adjacentRooms(graph_, roomNamed(graph_, question.room));
    for (const AdjacentRoom& adjacent : beside) {
      tellRoom(adjacent.room);
      for (const NodeId door : adjacent.doors) tellDoor(door);
    }
    if (beside.empty()) text_ << "none\n";
  }

  [[nodiscard]] std::string text() const { return text_.str(); }

 private:
  void tellRoom(NodeId id) {
    const RoomAttributes& room = graph_.room(id);
    text_ << cell(room.name) << ' ' << cell(room.label) << ' ' << room.area_m2 << " m2\n";
  }

  void tellDoor(NodeId id) {
    const Node& node = graph_.at(id);
    const auto& door = std::get<DoorAttributes>(node.attributes);
    text_ << "door at " << node.position.x() << ' ' << node.position.y() << ", " << door.width_m
          << " m wide, between rooms " << roomNumber(door.room_a) << " and "
          << roomNumber(door.room_b) << '\n';
  }

  void tellStairs(NodeId id) {
    const Node& node = graph_.at(id);
    const auto& stairs = std::get<StairsAttributes>(node.attributes);
    text_ << nameOf(stairs.kind) << " at " << node.position.x() << ' ' << node.position.y() << ", "
          << stairs.rise_m << " m high, from room " << roomNumber(stairs.lower_room)
          << " up to room " << roomNumber(stairs.upper_room) << '\n';
  }

  void tellObject(NodeId id) {
    const Node& node = graph_.at(id);
    const auto& object = std::get<ObjectAttributes>(node.attributes);
    const std::optional<NodeId> room = graph_.roomOf(id);
    text_ << "object " << id - firstId(NodeType::kObject) << ' ' << cell(object.class_name)
          << " at " << node.position.x() << ' ' << node.position.y() << ' ' << node.position.z()
          << (room ? " in room " + std::to_string(roomNumber(*room)) : " in no room") << '\n';
  }

  const SceneGraph& graph_;
  std::ostringstream text_;
};

}  // namespace

GraphQuestion questionIn(const std::string& text) {
  Words words(text);
  const std::optional<GraphQuestion> question = understood(words);
  if (!question || !words.atEnd()) {
    throw UsageError("--query is '" + (text.empty() ? text : cell(text)) +
                     "'; allowed are 'room at X Y', 'way X Y to X Y', 'contents of ROOM', "
                     "'nearest CLASS at X Y' and 'adjacent to ROOM', X and Y in metres, with a "
                     "third number for the height in a building with storeys");
  }
  return *question;
}

std::string answerTo(const GraphQuestion& question, const SceneGraph& graph) {
  Answer answer(graph);
  std::visit(answer, question);
  return answer.text();
}

std::string cell(const std::string& text) {
  constexpr std::size_t kLongest = 24;
  std::string printed = text.substr(0, kLongest);
  // Not in the middle of a UTF-8 character.
  const auto continues = [&](std::size_t at) {
    return at < text.size() && (static_cast<unsigned char>(text[at]) & 0xC0U) == 0x80U;
  };
  while (continues(printed.size()) && !printed.empty()) printed.pop_back();
  std::replace_if(
      printed.begin(), printed.end(),
      [](char c) { return static_cast<unsigned char>(c) < 0x20U || c == 0x7F; }, '?');
  return printed.empty() ? "-" : printed;
}

}  // namespace occusg::apps

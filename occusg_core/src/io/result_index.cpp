// SPDX-License-Identifier: BSD-3-Clause
#include "io/result_index.hpp"

#include <filesystem>
#include <nlohmann/json.hpp>

#include "io/file_bytes.hpp"
#include "io/json_text.hpp"
#include "occusg/error.hpp"

namespace occusg {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr const char* kResultFormat = "occusg-result-files";
constexpr int kResultVersion = 1;
constexpr std::size_t kMaxIndexBytes = std::size_t{1} << 20U;
constexpr std::size_t kMaxResultBytes = std::size_t{2} << 30U;

bool isAsMarked(const fs::path& file, const json& mark, const std::string& where) {
  const json& bytes = member(mark, "bytes", where);
  FileMark wanted;
  if (!bytes.is_number_unsigned() ||
      !parseChecksum(stringOf(member(mark, "fnv1a", where), where), wanted.checksum))
    throw refuse(where, "has no size and checksum", "the index of a run is needed");
  wanted.bytes = bytes.get<std::size_t>();
  std::error_code failed;
  return fs::file_size(file, failed) == wanted.bytes && !failed &&
         markOf(readFile(file.string(), kMaxResultBytes)) == wanted;
}

}  // namespace

std::string toResultIndex(const std::map<std::string, FileMark>& files) {
  json list = json::array();
  for (const auto& [name, mark] : files) {
    list.push_back(
        {{"name", name}, {"bytes", mark.bytes}, {"fnv1a", std::to_string(mark.checksum)}});
  }
  return jsonDocument({{"format", kResultFormat}, {"version", kResultVersion}, {"files", list}});
}

std::optional<std::vector<std::string>> filesOfOtherRuns(const std::string& folder) {
  const fs::path index = fs::path(folder) / kResultIndexFile;
  std::error_code failed;
  if (!fs::exists(index, failed)) return std::nullopt;
  const std::string where = index.string();
  const json document = parseJson(readFile(where, kMaxIndexBytes), where);
  const json* format = optionalMember(document, "format", where);
  if (format == nullptr || *format != kResultFormat) return std::nullopt;
  std::vector<std::string> others;
  const std::string where_name = where + ": name";
  for (const json& file : arrayOf(member(document, "files", where), where + ": files")) {
    const std::string name = stringOf(member(file, "name", where), where_name);
    if (fs::path(name).filename() != name)
      throw refuse(where, "names a file in another folder", "plain file names are needed");
    std::string where_file = where;
    where_file.append(" ").append(name);
    if (!isAsMarked(fs::path(folder) / name, file, where_file)) others.push_back(name);
  }
  return others;
}

}  // namespace occusg

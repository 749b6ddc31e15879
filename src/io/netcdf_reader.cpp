// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <deque>
#include <utility>

#include "base/check.h"
#include "io/byte_source.h"
#include "io/child_process.h"
#include "io/netcdf_file.h"
#include "io/netcdf_library_reader.h"
#include "io/sandbox.h"
#include "io/wire.h"

namespace sonar::netcdf {
namespace {

enum What : int {
  find_group,
  find_variable,
  find_attribute,
  dimension_length,
  attribute_text,
  attribute_texts,
  attribute_whole,
  variable_names,
  variable_dimensions,
  variable_text,
  variable_number,
  variable_size,
  room,
  doubles,
  floats,
  wholes,
  ints,
  bytes,
  strings
};

constexpr std::uint64_t kLongestName = 4096;
constexpr std::uint64_t kMemory_bytes = 8ULL << 30U;

using wire::Bytes;
using wire::bytes_of;
using wire::encoded;

/// The name follows.
struct Question {
  std::int32_t what = 0;
  std::int32_t group = 0;
  std::uint64_t number = 0;
  std::uint64_t name_size = 0;
};

Bytes encoded(const Question& asked, const std::string& name) {
  Bytes out = encoded(Question{asked.what, asked.group, asked.number, name.size()});
  const Bytes tail = encoded(name);
  out.insert(out.end(), tail.begin(), tail.end());
  return out;
}

template <class T>
Bytes values(LibraryReader& in, const Question& asked, const std::string& name) {
  return encoded(in.values<T>(asked.group, name, asked.number));
}

/// What is asked of a variable's attribute: no name in netCDF holds a slash.
constexpr char kBetween = '/';
std::string joined(const std::string& variable, const std::string& attribute) {
  return variable + kBetween + attribute;
}

Bytes answer_of_variable(LibraryReader& in, const Question& asked, const std::string& name) {
  const std::size_t between = std::min(name.find(kBetween), name.size());
  const std::string variable = name.substr(0, between);
  const std::string attribute = name.substr(std::min(between + 1, name.size()));
  if (asked.what == variable_text) return encoded(in.text_of(asked.group, variable, attribute));
  return encoded(in.number_of(asked.group, variable, attribute));
}

Bytes answer(LibraryReader& in, const Question& asked, const std::string& name) {
  switch (asked.what) {
    case find_group:
      return encoded(in.find_group(asked.group, name));
    case find_variable:
      return encoded(int{in.has_variable(asked.group, name)});
    case find_attribute:
      return encoded(int{in.has_attribute(asked.group, name)});
    case dimension_length:
      return encoded(in.dimension(asked.group, name));
    case attribute_text:
      return encoded(in.text(asked.group, name));
    case attribute_texts:
      return encoded(in.texts(asked.group, name));
    case attribute_whole:
      return encoded(in.whole(asked.group, name));
    case variable_names:
      return encoded(in.variables(asked.group));
    case variable_dimensions:
      return encoded(in.dimensions_of(asked.group, name));
    case variable_text:
    case variable_number:
      return answer_of_variable(in, asked, name);
    case variable_size:
      return encoded(in.size(asked.group, name));
    case room:
      return encoded(int{in.can_hold(asked.number, static_cast<std::size_t>(asked.group))});
    case doubles:
      return values<double>(in, asked, name);
    case floats:
      return values<float>(in, asked, name);
    case wholes:
      return values<std::int64_t>(in, asked, name);
    case ints:
      return values<std::int32_t>(in, asked, name);
    case bytes:
      return values<std::uint8_t>(in, asked, name);
    case strings:
      return values<std::string>(in, asked, name);
    default:
      return {};
  }
}

/// The child: the whole file, and then question after question until nobody asks any more.
void serve(int stream, const ByteSource& source, std::uint64_t size) {
  if (!wire::greet(stream)) return;
  Bytes file(size);
  const auto got = source.read(0, file);
  file.resize(got ? *got : 0);
  (void)enter_sandbox(stream, Reach::nothing, kMemory_bytes);
  LibraryReader in(std::move(file));
  if (!wire::tell(stream, in.status(), encoded(in.root()))) return;
  Question asked;
  while (hear_all(stream, bytes_of(asked)) && asked.name_size <= kLongestName) {
    std::string name(asked.name_size, ' ');
    if (!hear_all(stream, std::as_writable_bytes(std::span(name)))) return;
    const Bytes said = answer(in, asked, name);
    if (!wire::tell(stream, in.status(), said)) return;
  }
}

template <class T>
constexpr What kValues = doubles;
template <>
constexpr What kValues<float> = floats;
template <>
constexpr What kValues<std::int64_t> = wholes;
template <>
constexpr What kValues<std::int32_t> = ints;
template <>
constexpr What kValues<std::uint8_t> = bytes;
template <>
constexpr What kValues<std::string> = strings;

}  // namespace

/// The other side of serve().
class ReaderProcess {
 public:
  ReaderProcess(ChildProcess child, std::uint64_t most) : child_(std::move(child)), most_(most) {}

  void foresee(const Question& asked, const std::string& name) {
    foreseen_.push_back(encoded(asked, name));
    unsaid_.insert(unsaid_.end(), foreseen_.back().begin(), foreseen_.back().end());
  }

  Result<Bytes> ask(const Question& asked, const std::string& name) {
    if (foreseen_.empty()) foresee(asked, name);
    SONAR_CHECK(foreseen_.front() == encoded(asked, name));
    foreseen_.pop_front();
    const Bytes said = std::exchange(unsaid_, {});
    if (!child_.say(said)) return fail(ErrorCode::format, "is damaged: reading it breaks the library for it");
    return wire::hear(child_, most_);
  }

 private:
  ChildProcess child_;
  std::uint64_t most_;
  std::deque<Bytes> foreseen_;  ///< questions whose answers were not heard yet
  Bytes unsaid_;                ///< the last of them
};

Reader::Reader(const std::filesystem::path& path, std::string named) : named_(std::move(named)) { start(path); }

void Reader::start(const std::filesystem::path& path) {
  const auto source = open_file(path);
  const auto size = source ? (*source)->size() : Result<std::uint64_t>(pass_on(source));
  if (!size) return refuse(size.error().code, size.error().text);
  const auto make = [&] {
    // Held so that no other thread is inside netCDF when the process is doubled; the copy lets it go.
    auto held = lock();
    return ChildProcess::start(
        [&](int stream) {
          held.unlock();
          serve(stream, **source, *size);
        },
        named_);
  };
  const std::uint64_t most = *size * kBytesPerByte + kLongestName;
  auto begun = wire::begin(make, most);
  if (!begun) return refuse(begun.error().code, begun.error().text);
  process_ = std::make_unique<ReaderProcess>(std::move(begun->child), most);
  root_ = wire::decoded<int>(begun->said).value_or(-1);
}

Reader::~Reader() = default;

void Reader::refuse(ErrorCode code, std::string text) {
  if (status_) status_ = fail(code, std::move(text), {.file = named_});
}

template <class T>
T Reader::ask(int what, int group, const std::string& name, std::uint64_t number) {
  if (!status_) return {};
  const auto said = process_->ask({what, group, number, 0}, name);
  if (!said) {
    refuse(said.error().code, said.error().text);
    return {};
  }
  auto value = wire::decoded<T>(*said);
  if (!value) refuse(ErrorCode::format, "is damaged: reading it breaks the library for it");
  return value ? std::move(*value) : T{};
}

int Reader::find_group(int parent, const std::string& name) {
  const int id = ask<int>(netcdf::find_group, parent, name);
  return ok() ? id : -1;
}

int Reader::group(int parent, const std::string& name) {
  const int id = find_group(parent, name);
  if (id < 0) refuse(ErrorCode::format, "there is no group '/" + name + "'");
  return id;
}

bool Reader::has_variable(int group, const std::string& name) { return ask<int>(find_variable, group, name) != 0; }
bool Reader::has_attribute(int group, const std::string& name) { return ask<int>(find_attribute, group, name) != 0; }
std::size_t Reader::dimension(int group, const std::string& name) {
  return ask<std::size_t>(dimension_length, group, name);
}
std::string Reader::text(int group, const std::string& name) { return ask<std::string>(attribute_text, group, name); }
std::int64_t Reader::whole(int group, const std::string& name) {
  return ask<std::int64_t>(attribute_whole, group, name);
}
std::size_t Reader::size(int group, const std::string& name) { return ask<std::size_t>(variable_size, group, name); }

std::vector<std::string> Reader::texts(int group, const std::string& name) {
  return ask<std::vector<std::string>>(attribute_texts, group, name);
}

std::vector<std::string> Reader::variables(int group) {
  return ask<std::vector<std::string>>(variable_names, group, {});
}
std::vector<std::string> Reader::dimensions_of(int group, const std::string& variable) {
  return ask<std::vector<std::string>>(variable_dimensions, group, variable);
}
std::string Reader::text_of(int group, const std::string& variable, const std::string& name) {
  return ask<std::string>(variable_text, group, joined(variable, name));
}
double Reader::number_of(int group, const std::string& variable, const std::string& name) {
  return ask<double>(variable_number, group, joined(variable, name));
}

bool Reader::can_hold(std::size_t rows, std::size_t bytes_a_row) {
  return ask<int>(room, static_cast<int>(bytes_a_row), {}, rows) != 0;
}

template <class T>
void Reader::foresee_values(int group, const std::string& name, std::size_t expected) {
  if (ok()) process_->foresee({kValues<T>, group, expected, 0}, name);
}

void Reader::foresee_variable(int group, const std::string& name) {
  if (ok()) process_->foresee({find_variable, group, 0, 0}, name);
}

template <class T>
std::vector<T> Reader::values(int group, const std::string& name, std::size_t expected) {
  auto values = ask<std::vector<T>>(kValues<T>, group, name, expected);
  if (ok() && values.size() != expected) refuse(ErrorCode::format, "is damaged: reading it breaks the library for it");
  return ok() ? std::move(values) : std::vector<T>{};
}

template void Reader::foresee_values<double>(int, const std::string&, std::size_t);
template void Reader::foresee_values<std::int64_t>(int, const std::string&, std::size_t);
template void Reader::foresee_values<std::string>(int, const std::string&, std::size_t);
template std::vector<double> Reader::values(int, const std::string&, std::size_t);
template std::vector<float> Reader::values(int, const std::string&, std::size_t);
template std::vector<std::int64_t> Reader::values(int, const std::string&, std::size_t);
template std::vector<std::int32_t> Reader::values(int, const std::string&, std::size_t);
template std::vector<std::uint8_t> Reader::values(int, const std::string&, std::size_t);
template std::vector<std::string> Reader::values(int, const std::string&, std::size_t);

}  // namespace sonar::netcdf

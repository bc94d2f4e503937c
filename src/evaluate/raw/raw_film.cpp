#include "evaluate/raw/raw_film.h"

#include <zlib.h>

#include "base/diagnostics.h"
#include "evaluate/raw/raw_json.h"
#include "evaluate/report/scene_json.h"
#include "image/exr_words.h"

namespace duet {

namespace {

/// Of the format; files of another are refused.
constexpr int kFormat = 1;
const std::string kText = "duetRawFilm", kChecksum = "duetRawFilmChecksum";

/// CRC-32 (ISO 3309) of words as they lie in a file, the lowest byte first.
class Checksum {
 public:
  void add(std::string_view text) { add(text.data(), text.size()); }
  void add(std::span<const uint32_t> words) {
    add(reinterpret_cast<const char*>(words.data()), words.size_bytes());
  }
  std::string text() const { return fmt::format("{:08x}", crc_); }

 private:
  void add(const char* bytes, size_t count) {
    crc_ = crc32_z(crc_, reinterpret_cast<const Bytef*>(bytes), count);
  }
  uLong crc_ = crc32(0, nullptr, 0);
};

/// The planes of all films; those of several films begin with the film's number.
struct Planes {
  struct Place {
    size_t film, plane;
  };
  std::vector<WordPlane> words;
  std::vector<Place> places;

  explicit Planes(const std::vector<Film>& films) {
    for (size_t f = 0; f < films.size(); ++f) {
      const std::vector<FilmPlane> planes = films[f].planes();
      for (size_t p = 0; p < planes.size(); ++p) {
        const FilmPlane& plane = planes[p];
        WordPlane& w = words.emplace_back();
        w.name = films.size() > 1 ? fmt::format("film{}.{}", f, plane.name) : plane.name;
        w.width = plane.width, w.height = plane.height;
        for (const std::string& sum : plane.sums)
          for (int k = 0; k < 4; ++k) w.channels.push_back(fmt::format("{}.{}", sum, k));
        places.push_back({f, p});
      }
    }
  }
};

/// Copies the sums of a row as words.
class RowReader {
 public:
  RowReader(const std::vector<Film>& films, const Planes& planes)
      : films_(films), planes_(planes) {}
  void operator()(size_t plane, int y, std::span<uint32_t> words) {
    sums_.resize(words.size() / 4);
    const auto [film, own] = planes_.places[plane];
    films_[film].read_row(own, y, sums_);
    for (size_t i = 0; i < sums_.size(); ++i) {
      const auto w = sums_[i].words();
      std::copy(w.begin(), w.end(), words.begin() + ptrdiff_t(4 * i));
    }
  }

 private:
  const std::vector<Film>& films_;
  const Planes& planes_;
  std::vector<ExactSum> sums_;
};

std::string checksum_of(const std::string& text, const std::vector<Film>& films,
                        const Planes& planes) {
  Checksum sum;
  sum.add(text);
  const std::string of_text = sum.text();
  RowReader read(films, planes);
  std::vector<uint32_t> words;
  for (size_t i = 0; i < planes.words.size(); ++i) {
    const WordPlane& p = planes.words[i];
    words.resize(size_t(p.width) * p.channels.size());
    for (int y = 0; y < p.height; ++y) {
      read(i, y, words);
      sum.add(words);
    }
  }
  return of_text + " " + sum.text();
}

/// Counts, and where the tiles lie: the plane of samples has them side by side.
Json film_json(const Film& film) {
  // Tiles nearly always have the same number.
  bool same = true;
  std::vector<uint64_t> samples;
  for (const FilmTile& t : film.tiles()) {
    samples.push_back(t.samples());
    same &= t.samples() == samples[0];
  }
  Json columns = Json::array(), rows = Json::array();
  for (const FilmTile& t : film.tiles()) {
    const PixelBounds &b = t.stored(), &first = film.tiles()[0].stored();
    if (b.y0 == first.y0) columns.push_back({b.x0, b.x1});
    if (b.x0 == first.x0) rows.push_back({b.y0, b.y1});
  }
  return {{"passes", film.passes()},
          {"columns", std::move(columns)},
          {"rows", std::move(rows)},
          {"tile_samples", same && !samples.empty() ? Json(samples[0]) : Json(samples)}};
}

}  // namespace

std::string difference(const RawImage& a, const RawImage& b) {
  const Json of_a = identity_json(a), of_b = identity_json(b);
  for (auto i = of_a.begin(); i != of_a.end(); ++i)
    if (const Json& other = of_b.at(i.key()); i.value() != other) {
      if (!i.value().is_object() || !other.is_object())
        return fmt::format("\"{}\" is {}, not {}", i.key(), i.value().dump(), other.dump());
      for (auto k = i.value().begin(); k != i.value().end(); ++k)
        if (const Json& inner = other.at(k.key()); k.value() != inner)
          return fmt::format("\"{}\" is {}, not {}", k.key(), k.value().dump(), inner.dump());
    }
  return "";
}

void write_raw_film(const std::string& path, const RawImage& image, const RenderState& state) {
  Json films = Json::array();
  for (const Film& f : state.films) films.push_back(film_json(f));
  const Json j{{"format", kFormat},
               {"program", DUET_VERSION},
               {"image", identity_json(image)},
               {"appearance", appearance_json(image)},
               {"state", state_json(state)},
               {"films", std::move(films)}};
  const std::string text = json_text(j);
  const Planes planes(state.films);
  write_words(path, planes.words,
              {{kText, text}, {kChecksum, checksum_of(text, state.films, planes)}},
              RowReader(state.films, planes));
}

RawFilm::RawFilm(const std::string& path) : path_(path) {
  const WordReader reader(path);
  const std::string *text = reader.text(kText), *checksum = reader.text(kChecksum);
  if (!text || !checksum) throw ReadError(path + ": is no raw film of Duet");
  checksum_ = *checksum;
  Checksum sum;
  sum.add(*text);
  if (!checksum_.starts_with(sum.text() + " "))
    throw ReadError(fmt::format("{}: is damaged: the checksum of its text is {}, not {}", path,
                                sum.text(), checksum_.substr(0, 8)));
  try {
    read_text(*text);
  } catch (const nlohmann::json::exception& e) {
    throw ReadError(fmt::format("{}: is damaged: {}", path, e.what()));
  }
}

void RawFilm::read_text(const std::string& text) {
  const Json j = Json::parse(text);
  if (const int format = j.at("format"); format != kFormat)
    throw ReadError(fmt::format("{}: is a raw film of format {}, not {}", path_, format, kFormat));
  if (const std::string version = j.at("program"); version != DUET_VERSION)
    throw ReadError(
        fmt::format("{}: was written by Duet {}, this is {}", path_, version, DUET_VERSION));
  image_ = image_from_json(j.at("image"), j.at("appearance"));
  state_ = state_from_json(j.at("state"));
  for (const Json& f : j.at("films")) {
    const Json& samples = f.at("tile_samples");
    films_.push_back({f.at("passes"), samples.is_array()
                                          ? samples.get<std::vector<uint64_t>>()
                                          : std::vector<uint64_t>{samples.get<uint64_t>()}});
  }
}

void RawFilm::add_to(RenderState& state) const {
  state.films.reserve(films_.size());
  while (state.films.size() < films_.size())
    state.films.emplace_back(image_.layout, image_.contents);
  const WordReader reader(path_);
  const Planes planes(state.films);
  Checksum sum;
  sum.add(*reader.text(kText));
  std::vector<ExactSum> row;
  for (size_t i = 0; i < planes.words.size(); ++i)
    reader.read(planes.words[i], [&](int y, std::span<const uint32_t> words) {
      sum.add(words);
      row.clear();
      for (size_t k = 0; k < words.size(); k += 4) row.push_back(ExactSum::from_words(&words[k]));
      const auto [film, plane] = planes.places[i];
      state.films[film].add_row(plane, y, row);
    });
  if (!checksum_.ends_with(" " + sum.text()))
    throw ReadError(fmt::format("{}: is damaged: its checksum is {}, not {}", path_, sum.text(),
                                checksum_.substr(9)));
  for (size_t f = 0; f < films_.size(); ++f) {
    std::vector<uint64_t> samples = films_[f].tile_samples;
    if (samples.size() == 1) samples.resize(state.films[f].tiles().size(), samples[0]);
    if (samples.size() != state.films[f].tiles().size())
      throw ReadError(fmt::format("{}: is damaged: it has {} tiles, not {}", path_, samples.size(),
                                  state.films[f].tiles().size()));
    state.films[f].count(films_[f].passes, samples);
  }
  for (const SampleInterval& i : state_.samples.all()) state.samples.add(i);
  state.spp += state_.spp;
  state.variance.squares += state_.variance.squares;
  state.variance.count += state_.variance.count;
  state.counters.add(state_.counters);
  state.seconds += state_.seconds;
  state.rounds = state_.rounds;
}

}  // namespace duet

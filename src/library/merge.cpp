#include "duet/merge.h"

#include <stdexcept>

#include "evaluate/raw/merge.h"
#include "evaluate/report/memory_estimate.h"
#include "library/contents.h"

namespace duet {

namespace {

MergedFilms read_films(const std::vector<std::string>& films) {
  try {
    return merge_raw_films(films);
  } catch (const ReadError& e) {
    throw FileError(e.what());
  } catch (const TooLittleMemory& e) {
    throw MemoryError(e.what());
  }
}

}  // namespace

RenderedImage merge_films(const std::vector<std::string>& films) {
  if (films.empty()) throw std::invalid_argument("there are no films");
  for (const std::string& film : films) check_path(film);
  MergedFilms merged = read_films(films);
  if (merged.result.spp == 0) throw std::invalid_argument("the films have no samples");
  RenderedImage::Contents made{std::move(merged.result.image), merged.image.form, {}, false};
  made.header = header_of(merged, record_of(merged), to_string(merged.gaps));
  return RenderedImage(std::make_shared<const RenderedImage::Contents>(std::move(made)));
}

}  // namespace duet

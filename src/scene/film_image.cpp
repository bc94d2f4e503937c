#include "scene/film_image.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "math/spectrum.h"

namespace duet {

namespace {

/// The geometric mean of luminance, black pixels set to a small number. Source: Reinhard et al.
/// 2002, eq. 1.
double log_average(const Image& image) {
  double sum = 0;
  const size_t n = size_t(image.width) * image.height;
  for (size_t i = 0; i < n; ++i) {
    const float* p = &image.data[i * image.channels.size()];
    sum += std::log(1e-3 + std::max(0.0, double(Spectrum(p[0], p[1], p[2]).luminance())));
  }
  return std::exp(sum / double(n));
}

/// Reinhard et al., "Photographic Tone Reproduction for Digital Images", 2002, eqs. 1 to 4, applied
/// to luminance: `key` is the middle grey; `burn` from 0 to 1 lowers the luminance that becomes
/// white by the square of 1 − burn, as Mitsuba 0.6 does.
class Reinhard {
 public:
  Reinhard(const Image& image, double key, double burn) {
    double brightest = 0;
    const size_t n = size_t(image.width) * image.height;
    for (size_t i = 0; i < n; ++i)
      brightest = std::max(brightest, double(luminance(&image.data[i * image.channels.size()])));
    scale_ = key / log_average(image);
    const double white = brightest * scale_ * std::pow(std::clamp(1 - burn, 1e-8, 1.0), 2);
    inverse_white2_ = white > 0 ? 1 / (white * white) : 0;
  }
  double factor(const float* rgb) const {
    const double y = std::max(0.0, double(luminance(rgb))) * scale_;
    return scale_ * (1 + y * inverse_white2_) / (1 + y);
  }

 private:
  static float luminance(const float* rgb) { return Spectrum(rgb[0], rgb[1], rgb[2]).luminance(); }
  double scale_, inverse_white2_;
};

constexpr double kMiddleGrey = 0.18;

}  // namespace

bool has_alpha(PixelFormat f) {
  return f == PixelFormat::rgba || f == PixelFormat::xyza || f == PixelFormat::luminance_alpha;
}

bool is_grey(PixelFormat f) {
  return f == PixelFormat::luminance || f == PixelFormat::luminance_alpha;
}

template <class Value>
DisplayImage<Value> to_display(const Image& image, const DisplayOptions& options, bool grey,
                               bool with_alpha) {
  constexpr double kGreatest = std::numeric_limits<Value>::max();
  const DisplaySettings& settings = options.settings;
  ToneMapping tone = options.tone_mapping.value_or(ToneMapping{});
  if (settings.curve) {
    tone = ToneMapping{};
    tone.reinhard = settings.curve == ToneCurve::reinhard;
  }
  const bool is_film = settings.curve == ToneCurve::aces || settings.curve == ToneCurve::agx;
  const size_t n = size_t(image.width) * image.height, stride = image.channels.size();
  double scale = std::exp2(settings.exposure + (tone.reinhard ? 0 : tone.exposure));
  // Reinhard's operator begins with that.
  if (settings.automatic && !tone.reinhard) scale *= kMiddleGrey / log_average(image);
  std::optional<Reinhard> reinhard;
  if (tone.reinhard) reinhard.emplace(image, tone.key, tone.burn);
  const auto rounded = [](double v) {
    return Value(std::lround(kGreatest * std::clamp(v, 0.0, 1.0)));
  };
  const auto encode = [&](double v) {
    if (!(v > 0)) return Value(0);
    v = std::min(v, 1.0);
    return rounded(tone.gamma > 0 ? std::pow(v, 1 / tone.gamma) : linear_to_srgb(float(v)));
  };
  DisplayImage<Value> out;
  out.channels = (grey ? 1 : 3) + with_alpha;
  out.values.reserve(n * size_t(out.channels));
  for (size_t i = 0; i < n; ++i) {
    const float* p = &image.data[i * stride];
    double s = scale * (reinhard ? reinhard->factor(p) : 1.0);
    if (with_alpha && p[3] > 0) s /= p[3];
    if (is_film) {
      const Spectrum rgb = Spectrum(p[0], p[1], p[2]) * float(s);
      const Spectrum c = displayed(grey ? Spectrum(rgb.luminance()) : rgb, *settings.curve);
      for (int k = 0; k < (grey ? 1 : 3); ++k) out.values.push_back(rounded(double(c[k])));
    } else if (grey) {
      out.values.push_back(encode(Spectrum(p[0], p[1], p[2]).luminance() * s));
    } else {
      for (int c = 0; c < 3; ++c) out.values.push_back(encode(p[c] * s));
    }
    if (with_alpha) out.values.push_back(rounded(p[3]));
  }
  return out;
}

template DisplayImage<uint8_t> to_display(const Image&, const DisplayOptions&, bool, bool);
template DisplayImage<uint16_t> to_display(const Image&, const DisplayOptions&, bool, bool);

Image in_pixel_format(const Image& image, PixelFormat format) {
  if (image.channels[0] != "R") return image;
  const bool with_alpha = has_alpha(format);
  std::vector<std::string> names{"R", "G", "B"};
  if (is_grey(format)) names = {"Y"};
  if (format == PixelFormat::xyz || format == PixelFormat::xyza) names = {"X", "Y", "Z"};
  const size_t colours = names.size();
  if (with_alpha) names.push_back("A");
  names.insert(names.end(), image.channels.begin() + 4, image.channels.end());
  Image out(image.width, image.height, names);
  const size_t from_stride = image.channels.size(), to_stride = names.size();
  for (size_t i = 0; i < size_t(image.width) * image.height; ++i) {
    const float* p = &image.data[i * from_stride];
    float* q = &out.data[i * to_stride];
    const Spectrum rgb(p[0], p[1], p[2]);
    if (colours == 1) {
      *q++ = rgb.luminance();
    } else if (names[0] == "X") {
      *q++ = 0.412453f * rgb.r + 0.357580f * rgb.g + 0.180423f * rgb.b;
      *q++ = rgb.luminance();
      *q++ = 0.019334f * rgb.r + 0.119193f * rgb.g + 0.950227f * rgb.b;
    } else {
      for (int c = 0; c < 3; ++c) *q++ = rgb[c];
    }
    if (with_alpha) *q++ = p[3];
    std::copy(p + 4, p + from_stride, q);
  }
  return out;
}

}  // namespace duet

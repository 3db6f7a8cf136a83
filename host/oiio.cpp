#include "oiio.h"

#include <OpenImageIO/imageio.h>
#include <cstdio>
#include <string>

static OIIO::TypeDesc type_of(image_sample sample)
{
    return sample == IMAGE_U8    ? OIIO::TypeDesc::UINT8
           : sample == IMAGE_U16 ? OIIO::TypeDesc::UINT16
                                 : OIIO::TypeDesc::FLOAT;
}

static int fail(char *message, size_t size, const std::string &text)
{
    std::snprintf(message, size, "%s", text.empty() ? "unknown error" : text.c_str());
    return -1;
}

static int can_write(const char *path)
{
    bool can = OIIO::ImageOutput::create(path) != nullptr;
    if (!can)
        OIIO::geterror(); // or it is printed when the program ends
    return can;
}

static int write_samples(const image *im, const char *path, char *message, size_t message_size)
{
    auto output = OIIO::ImageOutput::create(path);
    if (!output)
        return fail(message, message_size, OIIO::geterror());
    OIIO::ImageSpec spec(int(im->width), int(im->height), int(im->channels), type_of(im->sample));
    if (!output->open(path, spec) || !output->write_image(type_of(im->sample), im->samples) || !output->close())
        return fail(message, message_size, output->geterror());
    return 0;
}

static int read_size(image *im, const char *path, char *message, size_t message_size)
{
    auto input = OIIO::ImageInput::open(path);
    if (!input)
        return fail(message, message_size, OIIO::geterror());
    const OIIO::ImageSpec &spec = input->spec();
    im->width = uint32_t(spec.width);
    im->height = uint32_t(spec.height);
    im->channels = uint32_t(spec.nchannels);
    im->sample = spec.format.basesize() == 1 ? IMAGE_U8 : spec.format.basesize() == 2 ? IMAGE_U16 : IMAGE_F32;
    return 0;
}

static int read_samples(image *im, const char *path, char *message, size_t message_size)
{
    auto input = OIIO::ImageInput::open(path);
    if (!input)
        return fail(message, message_size, OIIO::geterror());
    if (!input->read_image(0, 0, 0, int(im->channels), type_of(im->sample), im->samples))
        return fail(message, message_size, input->geterror());
    return 0;
}

extern "C" const oiio_door gnomon_oiio = {can_write, write_samples, read_size, read_samples};

// What the page's script calls: a text goes in, a text comes out.
#include "docs/live/live.hpp"
#include "docs/live/same_bits.hpp"

#include <cstdint>
#include <cstdlib>
#include <string>

namespace {

std::string request;
space::live::Reply reply;

}  // namespace

extern "C" {

/// Where the script writes a request of so many bytes.
__attribute__((export_name("request_buffer"))) char* request_buffer(std::size_t size) {
    request.assign(size, ' ');
    return request.data();
}
/// Answers it; the number of bytes of the answer.
__attribute__((export_name("answer_request"))) std::size_t answer_request() {
    reply = space::live::reply_to(request);
    return reply.text.size();
}
/// The answer, until the next request.
__attribute__((export_name("answer_bytes"))) const char* answer_bytes() {
    return reply.text.data();
}
/// The pixels of its picture, four bytes each.
__attribute__((export_name("picture_bytes"))) const std::uint8_t* picture_bytes() {
    return reply.pixels.data();
}

/// What a test compares with a program's (docs/live/same_bits.hpp), as an answer.
__attribute__((export_name("same_bits"))) std::size_t same_bits(std::uint32_t seed,
                                                                std::uint32_t rays) {
    reply = {space::live::same_bits(seed, rays)};
    return reply.text.size();
}

// What an exception would have been ends the call: the script sees a trap, shows the drawing that
// was there, and says so.
void* __cxa_allocate_exception(std::size_t size) {
    return std::malloc(size);
}
void __cxa_throw(void*, void*, void (*)(void*)) {
    __builtin_trap();
}
}

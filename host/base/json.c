/* JSON parser: recursive descent over a byte range; every value lives in the document's arena. */
#include "json.h"
#include "utf8.h"

#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct {
    json_doc *doc;
    const char *text;
    size_t n_bytes, at, n_values;
    int depth;
    char *error;
    size_t error_bytes;
} parser;

static bool parse_value(parser *p, json_value *value);

static bool fail_at(parser *p, size_t offset, const char *what)
{
    size_t line = 1, column = 1;
    for (size_t i = 0; i < offset; i++) {
        if (p->text[i] == '\n') {
            line++;
            column = 1;
        } else column++;
    }
    snprintf(p->error, p->error_bytes, "%zu:%zu: %s", line, column, what);
    return false;
}

static bool fail(parser *p, const char *what)
{
    return fail_at(p, p->at, what);
}

/* The end of the text reads as -1, which no case of the grammar matches. */
static int peek(const parser *p)
{
    return p->at < p->n_bytes ? (unsigned char)p->text[p->at] : -1;
}

static void skip_space(parser *p)
{
    for (;;) {
        int c = peek(p);
        if (c != ' ' && c != '\t' && c != '\n' && c != '\r') return;
        p->at++;
    }
}

static bool is_digit(int c)
{
    return c >= '0' && c <= '9';
}

static bool parse_literal(parser *p, json_value *value, const char *word, json_type type, double number)
{
    size_t n = strlen(word);
    if (p->n_bytes - p->at < n || memcmp(p->text + p->at, word, n) != 0) return fail(p, "a value is expected");
    p->at += n;
    value->type = type;
    value->number = number;
    return true;
}

static bool skip_digits(parser *p)
{
    if (!is_digit(peek(p))) return fail(p, "a digit is expected");
    while (is_digit(peek(p))) p->at++;
    return true;
}

static bool skip_number(parser *p)
{
    if (peek(p) == '-') p->at++;
    if (peek(p) == '0') {
        p->at++;
        if (is_digit(peek(p))) return fail(p, "a number has no leading zero");
    } else if (!skip_digits(p)) return false;
    if (peek(p) == '.') {
        p->at++;
        if (!skip_digits(p)) return false;
    }
    if (peek(p) == 'e' || peek(p) == 'E') {
        p->at++;
        if (peek(p) == '+' || peek(p) == '-') p->at++;
        if (!skip_digits(p)) return false;
    }
    return true;
}

static bool parse_number(parser *p, json_value *value)
{
    size_t start = p->at;
    if (!skip_number(p)) return false;
    size_t n = p->at - start;
    char few[64]; /* a copy: the text need not be terminated */
    char *copy = n < sizeof few ? few : arena_alloc(&p->doc->memory, n + 1, 1);
    if (!copy) return fail(p, "out of memory");
    memcpy(copy, p->text + start, n);
    copy[n] = 0;
    value->type = JSON_NUMBER;
    value->number = strtod(copy, NULL);
    return isfinite(value->number) || fail_at(p, start, "the number is too large");
}

static size_t utf8_encode(char *out, uint32_t code)
{
    static const unsigned char lead[5] = {0, 0, 0xC0, 0xE0, 0xF0};
    if (code < 0x80) {
        out[0] = (char)code;
        return 1;
    }
    size_t length = code < 0x800 ? 2 : code < 0x10000 ? 3 : 4;
    for (size_t i = length - 1; i > 0; i--) {
        out[i] = (char)(0x80 | (code & 0x3F));
        code >>= 6;
    }
    out[0] = (char)(lead[length] | code);
    return length;
}

static bool parse_hex4(parser *p, uint32_t *code)
{
    *code = 0;
    for (int i = 0; i < 4; i++) {
        int c = peek(p);
        int digit = is_digit(c)            ? c - '0'
                    : c >= 'a' && c <= 'f' ? c - 'a' + 10
                    : c >= 'A' && c <= 'F' ? c - 'A' + 10
                                           : -1;
        if (digit < 0) return fail(p, "four hexadecimal digits are expected after \\u");
        *code = *code * 16 + (uint32_t)digit;
        p->at++;
    }
    return true;
}

/* Behind \u: one code unit, or the two of a surrogate pair. U+FFFD for zero and for half of a pair. */
static bool parse_unicode(parser *p, char *out, size_t *n_out)
{
    uint32_t code, low = 0;
    if (!parse_hex4(p, &code)) return false;
    const size_t behind = p->at;
    if (code >= 0xD800 && code < 0xDC00 && p->n_bytes - behind >= 2 && memcmp(p->text + behind, "\\u", 2) == 0) {
        p->at += 2;
        if (!parse_hex4(p, &low)) return false;
        if (low >= 0xDC00 && low < 0xE000) code = 0x10000 + ((code - 0xD800) << 10) + (low - 0xDC00);
        else p->at = behind;
    }
    if (code == 0 || (code >= 0xD800 && code < 0xE000)) {
        code = 0xFFFD;
        p->doc->n_replaced++;
    }
    *n_out += utf8_encode(out + *n_out, code);
    return true;
}

static bool parse_escape(parser *p, char *out, size_t *n_out)
{
    static const char names[] = "\"\\/bfnrt", codes[] = "\"\\/\b\f\n\r\t";
    int c = peek(p);
    if (c == 'u') {
        p->at++;
        return parse_unicode(p, out, n_out);
    }
    const char *name = c > 0 ? strchr(names, c) : NULL;
    if (!name) return fail(p, "unknown escape");
    out[(*n_out)++] = codes[name - names];
    p->at++;
    return true;
}

/* An escape is never longer decoded than written, so the distance to the closing quote bounds the copy. */
static size_t string_bound(const parser *p)
{
    size_t end = p->at;
    while (end < p->n_bytes && p->text[end] != '"') end += p->text[end] == '\\' ? 2 : 1;
    return (end < p->n_bytes ? end : p->n_bytes) - p->at;
}

static bool parse_string(parser *p, const char **out)
{
    size_t start = p->at++, n = 0;
    char *copy = arena_alloc(&p->doc->memory, string_bound(p) + 1, 1);
    if (!copy) return fail(p, "out of memory");
    *out = copy;
    for (;;) {
        int c = peek(p);
        if (c < 0) return fail_at(p, start, "the string does not end");
        if (c == '"') break;
        if (c < 0x20 && c != '\t' && c != '\n' && c != '\r') return fail(p, "control character in a string");
        if (c == '\\') {
            p->at++;
            if (!parse_escape(p, copy, &n)) return false;
            continue;
        }
        size_t length = utf8_length((const unsigned char *)p->text + p->at, p->n_bytes - p->at);
        if (length == 0) return fail(p, "malformed UTF-8");
        memcpy(copy + n, p->text + p->at, length);
        n += length;
        p->at += length;
    }
    p->at++;
    return true;
}

static json_value *add_child(parser *p, json_value *parent)
{
    if (++p->n_values > JSON_MAX_VALUES) {
        fail(p, "more than 1048576 values");
        return NULL;
    }
    json_value *child = arena_alloc(&p->doc->memory, 1, sizeof *child);
    json_value **children = arena_grow(&p->doc->memory, parent->children, parent->n_children, sizeof *children);
    if (!child || !children) {
        fail(p, "out of memory");
        return NULL;
    }
    parent->children = children;
    children[parent->n_children] = child;
    child->parent = parent;
    child->child_idx = parent->n_children++;
    child->offset = p->at;
    return child;
}

static int compare_keys(const void *a, const void *b)
{
    const json_value *x = *(json_value *const *)a, *y = *(json_value *const *)b;
    int order = strcmp(x->key, y->key);
    return order ? order : (x->offset > y->offset) - (x->offset < y->offset);
}

/* Of members with one key the last counts, as in other readers. */
static void drop_members(parser *p, json_value *object, json_value *const *sorted)
{
    size_t n_kept = 0, n = object->n_children;
    for (size_t i = 1; i < n; i++) {
        if (strcmp(sorted[i - 1]->key, sorted[i]->key) != 0) continue;
        if (p->doc->n_duplicates++ == 0 || p->doc->duplicate == sorted[i - 1]) p->doc->duplicate = sorted[i];
        sorted[i - 1]->key = NULL;
    }
    for (size_t i = 0; i < n; i++) {
        json_value *child = object->children[i];
        if (!child->key) continue;
        child->child_idx = n_kept;
        object->children[n_kept++] = child;
    }
    object->n_children = n_kept;
}

/* Sorted neighbours rather than all pairs: an object of a hundred thousand keys must not take minutes. */
static bool drop_duplicates(parser *p, json_value *object)
{
    size_t n = object->n_children;
    if (n < 2) return true;
    json_value **sorted = arena_alloc(&p->doc->memory, n, sizeof(json_value *));
    if (!sorted) return fail(p, "out of memory");
    memcpy(sorted, object->children, n * sizeof(json_value *));
    qsort(sorted, n, sizeof(json_value *), compare_keys);
    drop_members(p, object, sorted);
    return true;
}

static bool parse_member(parser *p, json_value *container)
{
    json_value *child = add_child(p, container);
    if (!child) return false;
    if (container->type == JSON_OBJECT) {
        if (peek(p) != '"') return fail(p, "a key is expected");
        if (!parse_string(p, &child->key)) return false;
        skip_space(p);
        if (peek(p) != ':') return fail(p, "':' is expected");
        p->at++;
        skip_space(p);
    }
    return parse_value(p, child);
}

static bool parse_container(parser *p, json_value *value, json_type type, char end)
{
    value->type = type;
    p->at++;
    if (++p->depth > JSON_MAX_DEPTH) return fail(p, "nested too deeply");
    skip_space(p);
    if (peek(p) != end) {
        for (;;) {
            if (!parse_member(p, value)) return false;
            skip_space(p);
            if (peek(p) != ',') break;
            p->at++;
            skip_space(p);
        }
    }
    if (peek(p) != end) return fail(p, type == JSON_OBJECT ? "',' or '}' is expected" : "',' or ']' is expected");
    p->at++;
    p->depth--;
    return type != JSON_OBJECT || drop_duplicates(p, value);
}

static bool parse_value(parser *p, json_value *value)
{
    switch (peek(p)) {
    case '{':
        return parse_container(p, value, JSON_OBJECT, '}');
    case '[':
        return parse_container(p, value, JSON_ARRAY, ']');
    case '"':
        value->type = JSON_STRING;
        return parse_string(p, &value->string);
    case 't':
        return parse_literal(p, value, "true", JSON_BOOL, 1);
    case 'f':
        return parse_literal(p, value, "false", JSON_BOOL, 0);
    case 'n':
        return parse_literal(p, value, "null", JSON_NULL, 0);
    case '-':
    case '0':
    case '1':
    case '2':
    case '3':
    case '4':
    case '5':
    case '6':
    case '7':
    case '8':
    case '9':
        return parse_number(p, value);
    default:
        return fail(p, "a value is expected");
    }
}

static bool parse_document(parser *p)
{
    p->doc->root = arena_alloc(&p->doc->memory, 1, sizeof *p->doc->root);
    if (!p->doc->root) return fail(p, "out of memory");
    skip_space(p);
    p->doc->root->offset = p->at;
    if (!parse_value(p, p->doc->root)) return false;
    skip_space(p);
    return p->at == p->n_bytes || fail(p, "text after the end of the document");
}

int json_parse(json_doc *doc, const char *text, size_t n_bytes, char *error, size_t error_bytes)
{
    *doc = (json_doc){0};
    parser p = {.doc = doc, .text = text, .n_bytes = n_bytes, .error = error, .error_bytes = error_bytes};
    if (parse_document(&p)) return 0;
    json_free(doc);
    return -1;
}

void json_free(json_doc *doc)
{
    arena_release(&doc->memory, NULL);
    doc->root = NULL;
}

const json_value *json_get(const json_value *object, const char *key)
{
    if (!object || object->type != JSON_OBJECT) return NULL;
    for (size_t i = 0; i < object->n_children; i++) {
        if (strcmp(object->children[i]->key, key) == 0) return object->children[i];
    }
    return NULL;
}

const json_value *json_at(const json_value *array, size_t idx)
{
    if (!array || array->type != JSON_ARRAY || idx >= array->n_children) return NULL;
    return array->children[idx];
}

static void append(char *out, size_t out_bytes, size_t *n, char c)
{
    if (*n + 1 < out_bytes) out[(*n)++] = c;
}

static void append_step(const json_value *value, char *out, size_t out_bytes, size_t *n)
{
    char number[24];
    const char *step = value->key;
    if (!step) {
        snprintf(number, sizeof number, "%zu", value->child_idx);
        step = number;
    }
    append(out, out_bytes, n, '/');
    for (; *step; step++) {
        if (*step == '~' || *step == '/') {
            append(out, out_bytes, n, '~');
            append(out, out_bytes, n, *step == '~' ? '0' : '1');
        } else append(out, out_bytes, n, *step);
    }
}

void json_path(const json_value *value, char *out, size_t out_bytes)
{
    const json_value *chain[JSON_MAX_DEPTH + 1];
    size_t n_chain = 0, n = 0;
    if (out_bytes == 0) return;
    for (; value && value->parent && n_chain <= JSON_MAX_DEPTH; value = value->parent) chain[n_chain++] = value;
    if (n_chain == 0) append(out, out_bytes, &n, '/');
    while (n_chain > 0) append_step(chain[--n_chain], out, out_bytes, &n);
    out[n] = '\0';
}

const char *json_type_name(json_type type)
{
    static const char *const names[] = {"null", "a boolean", "a number", "a string", "an array", "an object"};
    return names[type];
}

#include "app/planner/patient/label_choice.h"
#include "geometry/mem.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

/* Label numbers ("11-18" is a run of them), and the names that the same labels bear where the file has names. */
typedef struct preset_row {
    case_surface part;
    const char *numbers;
    const char *names[4]; /* the first that the file has counts */
    bool required;
} preset_row;

/* DentalSegmentator (Dot and others 2024, J Dent 147): one label map, five labels. */
static const preset_row dental_segmentator[] = {
    {CASE_SKULL, "1", {"Upper Skull", "Maxilla & Upper Skull", "Maxilla"}, true},
    {CASE_MANDIBLE, "2", {"Mandible"}, true},
    {CASE_UPPER_TEETH, "3", {"Upper Teeth"}, false},
    {CASE_LOWER_TEETH, "4", {"Lower Teeth"}, false},
    {0}};

/* TotalSegmentator's task craniofacial_structures (Wasserthal and others 2023, Radiol Artif Intell 5). */
static const preset_row craniofacial[] = {{CASE_SKULL, "3", {"skull"}, true},
                                          {CASE_MANDIBLE, "1", {"mandible"}, true},
                                          {CASE_UPPER_TEETH, "7", {"teeth_upper"}, false},
                                          {CASE_LOWER_TEETH, "2", {"teeth_lower"}, false},
                                          {CASE_SKIN, "4", {"head"}, false},
                                          {0}};

/* ToothFairy2 and 3 (Bolelli and others 2024): jaws, and each tooth by its FDI number. */
static const preset_row tooth_fairy[] = {{CASE_SKULL, "2", {"Upper Jawbone"}, true},
                                         {CASE_MANDIBLE, "1", {"Lower Jawbone"}, true},
                                         {CASE_UPPER_TEETH, "11-18,21-28", {NULL}, false},
                                         {CASE_LOWER_TEETH, "31-38,41-48", {NULL}, false},
                                         {0}};

static const struct {
    const char *name;
    const preset_row *row;
} presets[] = {{"dental-segmentator", dental_segmentator},
               {"totalsegmentator-craniofacial", craniofacial},
               {"toothfairy", tooth_fairy}};
enum { PRESETS = sizeof presets / sizeof *presets };

void label_choice_free(label_choice *c)
{
    free(c->use);
    *c = (label_choice){0};
}

const char *label_preset_names(void) { return "dental-segmentator, totalsegmentator-craniofacial, toothfairy"; }

static const preset_row *find_preset(const char *name)
{
    for (int i = 0; i < PRESETS; i++)
        if (!strcmp(presets[i].name, name)) return presets[i].row;
    return NULL;
}

bool label_preset_check(const char *name, err *e)
{
    if (find_preset(name)) return true;
    return err_set(e, ERR_USAGE, "unknown preset \"%s\"; known are %s", name, label_preset_names());
}

static const label_use *find_use(const label_choice *c, int32_t label, int32_t layer)
{
    for (int i = 0; i < c->count; i++)
        if (c->use[i].label == label && c->use[i].layer == layer) return &c->use[i];
    return NULL;
}

/* The labels of the file in words: all, or those that c does not use. Returns how many. */
static int list_labels(const volume *v, const label_choice *c, char *text, size_t size)
{
    size_t n = 0;
    int count = 0;
    text[0] = 0;
    for (int32_t i = 0; i < v->segment_count; i++) {
        const volume_segment *s = &v->segment[i];
        if (c && find_use(c, s->label, s->layer)) continue;
        if (n + 70 < size) n += (size_t)snprintf(text + n, size - n, "%s\"%s\"", count ? ", " : "", s->name);
        count++;
    }
    if (v->segment_count) return count;
    uint8_t *seen = NEW_ARRAY(uint8_t, 65536);
    int64_t voxels = (int64_t)v->layers * v->size[0] * v->size[1] * v->size[2];
    for (int64_t i = 0; i < voxels; i++) seen[v->value[i] + 32768] = 1;
    for (int k = 0; k < 65536; k++) {
        if (!seen[k] || k == 32768 || (c && find_use(c, k - 32768, 0))) continue;
        if (n + 16 < size) n += (size_t)snprintf(text + n, size - n, "%s%d", count ? ", " : "", k - 32768);
        count++;
    }
    free(seen);
    return count;
}

int label_choice_unused(const label_choice *c, const volume *v, char *text, size_t size)
{
    return list_labels(v, c, text, size);
}

static bool has_voxels(const volume *v, int32_t label, int32_t layer)
{
    int64_t voxels = (int64_t)v->size[0] * v->size[1] * v->size[2];
    const int16_t *value = v->value + layer * voxels;
    for (int64_t i = 0; i < voxels; i++)
        if (value[i] == label) return true;
    return false;
}

static bool use_label(const char *path, case_surface part, const char *word, int32_t label, int32_t layer,
                      label_choice *c, err *e)
{
    const label_use *other = find_use(c, label, layer);
    if (other && other->part == part) return true;
    if (other)
        return err_at(e, ERR_USAGE, path, 0, NULL,
                      "the label \"%s\" is named for the %s and for the %s; a label makes one part", word,
                      case_surface_name(other->part), case_surface_name(part));
    c->use = GROW_ARRAY(label_use, c->use, c->count + 1);
    label_use *use = &c->use[c->count++];
    *use = (label_use){.part = part, .label = label, .layer = layer};
    snprintf(use->word, sizeof use->word, "%s", word);
    return true;
}

/* Every segment of the name; *found: how many. */
static bool use_named(const volume *v, const char *path, case_surface part, const char *name, label_choice *c,
                      int *found, err *e)
{
    *found = 0;
    for (int32_t i = 0; i < v->segment_count; i++) {
        const volume_segment *s = &v->segment[i];
        if (strcasecmp(s->name, name)) continue;
        ++*found;
        if (!use_label(path, part, name, s->label, s->layer, c, e)) return false;
    }
    return true;
}

static bool refuse_word(const volume *v, const char *path, const char *word, bool there, err *e)
{
    char known[700];
    list_labels(v, NULL, known, sizeof known);
    if (there) return err_at(e, ERR_INPUT, path, 0, NULL, "the label \"%s\" has no voxels; labels are %s", word, known);
    return err_at(e, ERR_INPUT, path, 0, NULL, "has no label \"%s\"; choose by %s: %s", word,
                  v->segment_count ? "name" : "number", known);
}

static bool use_word(const volume *v, const char *path, case_surface part, const char *word, label_choice *c, err *e)
{
    char *end;
    long number = strtol(word, &end, 10);
    int found = 0, from = c->count;
    bool is_number = *word && !*end && number && number > INT16_MIN && number <= INT16_MAX;
    if (!use_named(v, path, part, word, c, &found, e)) return false;
    if (!found && is_number && !v->segment_count) {
        found = 1;
        if (!use_label(path, part, word, (int32_t)number, 0, c, e)) return false;
    }
    if (!found) return refuse_word(v, path, word, false, e);
    for (int i = from; i < c->count; i++)
        if (has_voxels(v, c->use[i].label, c->use[i].layer)) return true;
    return c->count == from || refuse_word(v, path, word, true, e); /* a word that is said twice adds nothing */
}

bool label_choose_words(const volume *v, const char *path, case_surface part, const char *words, label_choice *c,
                        err *e)
{
    char *copy = mem_text(words), *rest = copy;
    bool good = true;
    while (good && rest) {
        char *word = strsep(&rest, ",");
        word += strspn(word, " ");
        for (size_t n = strlen(word); n && word[n - 1] == ' '; n--) word[n - 1] = 0;
        good = use_word(v, path, part, word, c, e);
    }
    free(copy);
    return good;
}

/* "11-18,21": those of the numbers that have voxels. */
static bool use_numbers(const volume *v, const char *path, case_surface part, const char *numbers, label_choice *c,
                        err *e)
{
    for (const char *at = numbers; *at;) {
        char *end;
        long first = strtol(at, &end, 10), last = *end == '-' ? strtol(end + 1, &end, 10) : first;
        for (long k = first; k <= last; k++) {
            char word[16];
            snprintf(word, sizeof word, "%ld", k);
            if (has_voxels(v, (int32_t)k, 0) && !use_label(path, part, word, (int32_t)k, 0, c, e)) return false;
        }
        at = *end ? end + 1 : end;
    }
    return true;
}

bool label_choose_preset(const volume *v, const char *path, const char *preset, case_surface part, label_choice *c,
                         err *e)
{
    for (const preset_row *row = find_preset(preset); row->numbers; row++) {
        int found = 0, from = c->count;
        if (row->part != part) continue;
        for (int k = 0; k < 4 && row->names[k] && !found; k++)
            if (!use_named(v, path, part, row->names[k], c, &found, e)) return false;
        if (!v->segment_count && !use_numbers(v, path, part, row->numbers, c, e)) return false;
        if (c->count > from || !row->required) return true;
        char known[700];
        list_labels(v, NULL, known, sizeof known);
        return err_at(e, ERR_INPUT, path, 0, NULL, "lacks the label of the %s that %s makes (%s, \"%s\"); it has %s",
                      case_surface_name(part), preset, row->numbers, row->names[0], known);
    }
    return true;
}

void label_choice_mask(const label_choice *c, const volume *v, case_surface part, mask *m)
{
    for (int i = 0; i < c->count; i++)
        if (c->use[i].part == part) mask_add_label(m, v, c->use[i].label, c->use[i].layer);
}

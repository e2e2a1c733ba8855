/* Files that a scene names: they lie in its folder. Their names may come from a machine that does not tell upper from
 * lower case. */
#define _XOPEN_SOURCE 700
#include "loader.h"

#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#ifndef __wasi__ /* the playground has no folders to look into */
#include <dirent.h>

enum { MAX_ENTRIES = 65536 }; /* of a folder */

/* Puts the folder's own spelling in the place of a name of the same length. Of several the first in the alphabet. */
static bool respell(const char *folder, char *name)
{
    DIR *dir = opendir(folder);
    char *found = NULL, best[1024] = "";
    const struct dirent *entry = dir ? readdir(dir) : NULL;
    for (int n = 0; entry && n < MAX_ENTRIES; n++, entry = readdir(dir)) {
        if (strlen(entry->d_name) >= sizeof best || !loader_same_word(entry->d_name, name)) continue;
        if (!best[0] || strcmp(entry->d_name, best) < 0) strcpy(best, entry->d_name);
        found = best;
    }
    if (dir) closedir(dir);
    if (found) memcpy(name, found, strlen(found));
    return found != NULL;
}

/* Corrects the case of the part of path behind its first n_folder characters. False: there is no such file at all. */
static bool respell_path(loader *l, char *path, size_t n_folder)
{
    struct stat about;
    for (char *part = path + n_folder; *part;) {
        const size_t n = strcspn(part, "/");
        char *end = part + n, behind = *end;
        *end = '\0';
        if (n > 0 && stat(path, &about) != 0) {
            char *folder = loader_format(l, "%.*s", (int)(part - path), part == path ? "" : path);
            if (!folder || !respell(*folder ? folder : ".", part)) return false;
        }
        *end = behind;
        part = end + (behind == '/');
    }
    return true;
}

/* Whether a link on the way to the path leads out of the scene's folder. */
static bool leads_out(const loader *l, const char *path)
{
    const char *slash = strrchr(l->path, '/');
    char *name = strndup(l->path, slash ? (size_t)(slash - l->path) + 1 : 0);
    char *folder = name ? realpath(*name ? name : ".", NULL) : NULL, *to = realpath(path, NULL);
    const size_t n = folder && folder[1] ? strlen(folder) : 0; /* all is in "/" */
    const bool out = to && (!folder || strncmp(to, folder, n) != 0 || to[n] != '/');
    free(name);
    free(folder);
    free(to);
    return out;
}
#else
static bool leads_out(const loader *l, const char *path)
{
    (void)l, (void)path;
    return false;
}

static bool respell_path(loader *l, char *path, size_t n_folder)
{
    (void)l, (void)path, (void)n_folder;
    return false;
}
#endif

bool loader_find_beside(loader *l, const char *name, const char **path, const char **problem)
{
    static const char *const outside = "is outside the folder of the scene, which only --outside allows";
    struct stat about;
    *path = name;
    *problem = loader_may_read(l, name) ? NULL : outside;
    if (*problem) return true;
    char *joined = loader_relative_path(l, name), *spelled = joined ? loader_format(l, "%s", joined) : NULL;
    if (!spelled) return false;
    const bool other = stat(joined, &about) != 0 && respell_path(l, spelled, strlen(joined) - strlen(name));
    *path = other ? spelled : joined;
    if (!l->options->outside && leads_out(l, *path)) *problem = outside;
    return !other || loader_note(l, "'%.200s' is read from '%.200s': upper and lower case differ", name, spelled);
}

# Places of the sources where a small change is wrong code: places_of(); the change: place(), with
# file, kind, line, before and after (lines without indentation), text (of the whole file). Sourced
# by tools/mutants.R.
#
# Kinds: sign, factor, comparison, index, allowance, arguments, logic, attitude. Comments, strings,
# preprocessor lines and the text of messages are left alone.

squeeze <- function(text) gsub("[[:space:]]+", " ", trimws(text))

# The place where characters from:to of the text become `new`.
place <- function(file, kind, whole, from, to, new) {
  changed <- paste0(substr(whole, 1L, from - 1L), new, substring(whole, to + 1L))
  before <- strsplit(whole, "\n", fixed = TRUE)[[1L]]
  after <- strsplit(changed, "\n", fixed = TRUE)[[1L]]
  newlines <- function(text) lengths(regmatches(text, gregexpr("\n", text, fixed = TRUE)))
  first <- newlines(substr(whole, 1L, from)) + 1L
  lines <- newlines(substr(whole, from, to))
  more <- length(after) - length(before)
  list(
    file = file, kind = kind, line = first,
    before = squeeze(paste(before[first:(first + lines)], collapse = " ")),
    after = squeeze(paste(after[first:(first + lines + more)], collapse = " ")),
    text = after
  )
}

# The text of a file, and its edits: kind, from, to, new.
places_of <- function(path) {
  whole <- paste(readLines(path, encoding = "UTF-8"), collapse = "\n")
  list(whole = whole, edits = if (endsWith(path, ".R")) r_edits(whole) else c_edits(whole))
}

edit <- function(kind, from, to, new) list(kind = kind, from = from, to = to, new = new)

opposite <- c(
  "<" = ">", ">" = "<", "<=" = ">=", ">=" = "<=", "==" = "!=", "!=" = "==", "&&" = "||",
  "||" = "&&", "&" = "|", "|" = "&", "+" = "-", "-" = "+"
)
# Names of allowances, and numbers that are as small as allowances.
is_allowance <- function(text) {
  grepl("(^|[._])(rounding|allowance|tolerance|tol|eps|ulps?)($|[._])|DBL_EPSILON", text)
}
is_small <- function(text) {
  number <- suppressWarnings(as.numeric(sub("L$", "", text)))
  is.finite(number) & number > 0 & number < 1e-6 & number > 1e-30
}
# Functions whose arguments may change places, or whose first two are of different kinds: the call
# then fails at once, which says little.
symmetric <- c(
  "max", "min", "pmax", "pmin", "sum", "any", "all", "identical", "union", "intersect", "setequal",
  "hypot", "fmax", "fmin", "rot_two_sum", "rot_two_prod", "lapply", "vapply", "sapply", "Map",
  "mapply", "Filter", "Reduce", "do.call", "switch", "if", "for", "while", "return", "sizeof",
  "inherits", "library", "tryCatch", "withCallingHandlers", "test_that", "list", "structure",
  "apply", "assign", "get0", "exists", "is.element", "isTRUE", "stopifnot", "outer", "crossprod",
  # Sums and products, the same to the last bit in either order; the size of an allocation.
  "rot_dd_mul", "rot_dd_add", "rot_pair_dd_mul", "rot_pair_dd_add", "rot_muldiv", "multiply",
  "rot_dd_sum2", "fma", "calloc", "strcmp", "swap"
)

# ---- R ------------------------------------------------------------------------------------------

# The attitude's inverse, whatever its form: a vector, rows of a matrix, columns of a list.
inverse_attitude <- paste0(
  "(function(q) { if (is.null(q)) NULL else if (is.list(q)) { q[2:4] <- lapply(q[2:4], `-`); q } ",
  "else if (is.matrix(q)) { q[, 2:4] <- -q[, 2:4]; q } else { q[2:4] <- -q[2:4]; q } })"
)

r_edits <- function(whole) {
  parsed <- parse(text = whole, keep.source = TRUE)
  data <- utils::getParseData(parsed, includeText = TRUE)
  lines <- strsplit(whole, "\n", fixed = TRUE)[[1L]]
  starts <- cumsum(c(0L, nchar(lines) + 1L))
  # Columns of parse data are bytes in a UTF-8 text; lines of code here are ASCII but for strings.
  data$from <- starts[data$line1] + data$col1
  data$to <- starts[data$line2] + data$col2
  above_row <- match(data$parent, data$id)
  below <- split(seq_len(nrow(data)), above_row)
  children <- vector("list", nrow(data))
  children[as.integer(names(below))] <- lapply(below, function(rows) {
    rows[order(data$from[rows], -data$to[rows])]
  })
  kids <- function(row) children[[row]]
  parent <- function(row) above_row[row]
  called <- function(row) {
    all <- kids(row)
    if (length(all) < 2L || data$token[all[2L]] != "'('") return("")
    head <- kids(all[1L])
    if (!length(head)) return("")
    last <- utils::tail(head, 1L)
    if (data$token[last] == "SYMBOL_FUNCTION_CALL") data$text[last] else ""
  }
  message_calls <- "^(abort|warn|inform|stop|warning|message|cat|cli_|format_error)"
  in_message <- function(row) {
    while (!is.na(row)) {
      if (data$token[row] == "expr" && grepl(message_calls, called(row))) return(TRUE)
      row <- parent(row)
    }
    FALSE
  }
  ascii <- vapply(lines, function(line) all(utf8ToInt(line) < 128L), NA)
  edits <- list()
  add <- function(kind, row, new, to = data$to[row]) {
    if (!ascii[data$line1[row]] || in_message(row)) return()
    edits[[length(edits) + 1L]] <<- edit(kind, data$from[row], to, new)
  }
  # Whether what a call returns is used in whatever order: sort(unique(c(a, b))), x %in% c(a, b).
  unordered <- function(row) {
    repeat {
      above <- parent(row)
      if (is.na(above)) return(FALSE)
      name <- called(above)
      if (name %in% c("sort", "range", "max", "min", "sum", "any", "all", "length")) return(TRUE)
      operator <- data$token[kids(above)]
      if (any(operator == "SPECIAL")) {
        return(any(data$text[kids(above)] == "%in%") && utils::tail(kids(above), 1L) == row)
      }
      if (!name %in% c("unique", "c", "abs", "unlist")) return(FALSE)
      row <- above
    }
  }
  plotted <- function(rows) any(grepl("ggplot2::|geom_|theme|scale_", data$text[rows]))

  for (row in which(data$terminal)) {
    token <- data$token[row]
    text <- data$text[row]
    up <- parent(row)
    if (is.na(up)) next
    siblings <- kids(up)
    if (token %in% c("'+'", "'-'") && data$token[up] == "expr") {
      if (length(siblings) == 3L && !plotted(siblings)) add("sign", row, opposite[[text]])
      if (length(siblings) == 2L && text == "-") add("sign", row, "+")
    } else if (token == "'*'") {
      add("factor", row, "* 2 *")
    } else if (token == "'/'") {
      add("factor", row, "/ 2 /")
    } else if (token %in% c("GT", "LT", "GE", "LE", "EQ", "NE")) {
      add("comparison", row, opposite[[text]])
    } else if (token %in% c("AND2", "OR2", "AND", "OR")) {
      add("logic", row, opposite[[text]])
    } else if (token == "NUM_CONST" && !text %in% c("TRUE", "FALSE", "NA", "Inf", "NaN") &&
               !startsWith(text, "NA_")) {
      above <- parent(up)
      around <- if (is.na(above)) integer() else kids(above)
      if (length(around) > 1L && data$token[around[2L]] %in% c("'['", "LBB")) {
        index <- as.integer(sub("L$", "", text))
        if (!is.na(index)) {
          add("index", row, paste0(if (index > 1L) index - 1L else index + 1L,
            if (endsWith(text, "L")) "L"))
        }
      } else if (is_small(text)) {
        add("allowance", row, paste0("(1000 * ", text, ")"))
      } else if (!endsWith(text, "L") && text != "0") {
        add("factor", row, paste0("(2 * ", text, ")"))
      }
    } else if (token == "SYMBOL" && data$token[up] == "expr") {
      if (length(siblings) > 1L) next
      above <- parent(up)
      around <- if (is.na(above)) integer() else kids(above)
      assigned <- length(around) > 1L && any(data$token[around] == "LEFT_ASSIGN") &&
        around[1L] == up
      # The name of a column or an element, an assigned part.
      if (assigned) next
      over <- above
      target <- FALSE
      while (!is.na(over)) {
        beyond <- parent(over)
        if (!is.na(beyond) && any(data$token[kids(beyond)] == "LEFT_ASSIGN") &&
            kids(beyond)[1L] == over) target <- TRUE
        over <- beyond
      }
      if (target) next
      if (is_allowance(text)) add("allowance", row, paste0("(1000 * ", text, ")"))
      argument <- !is.na(above) && nzchar(called(above))
      if (argument && text %in% c("q", "attitude", "attitude0", "quaternion", "attitudes")) {
        add("attitude", row, paste0(inverse_attitude, "(", text, ")"))
      }
    }
  }
  for (row in which(data$token == "expr")) {
    name <- called(row)
    text <- data$text[row]
    if (grepl("^x\\[5:8\\]$", text)) add("attitude", row, paste0(inverse_attitude, "(", text, ")"))
    if (!nzchar(name) || name %in% symmetric || grepl(message_calls, name)) next
    all <- kids(row)
    inner <- all[-c(1:2, length(all))]
    commas <- data$token[inner] == "','"
    groups <- split(inner[!commas], cumsum(commas)[!commas])
    plain <- vapply(groups, function(g) length(g) == 1L && data$token[g] == "expr", NA)
    if (length(groups) < 2L || !all(plain[1:2])) next
    a <- groups[[1L]]
    b <- groups[[2L]]
    first <- data$text[a]
    second <- data$text[b]
    if (first == second) next
    if (any(grepl("^[\"']|^function|^\\\\\\(|^ffi_", c(first, second)))) next
    if (name == "c" && unordered(row)) next
    if (!all(ascii[data$line1[a]:data$line2[b]]) || in_message(row)) next
    between <- substr(whole, data$to[a] + 1L, data$from[b] - 1L)
    edits[[length(edits) + 1L]] <- edit(
      "arguments", data$from[a], data$to[b], paste0(second, between, first)
    )
  }
  edits
}

# ---- C ------------------------------------------------------------------------------------------

# The text with comments, strings and preprocessor lines as blanks.
code_of_c <- function(whole) {
  blank <- function(text) gsub("[^\n]", " ", text)
  pattern <- "(?s)/\\*.*?\\*/|//[^\n]*|\"(?:[^\"\\\\]|\\\\.)*\"|'(?:[^'\\\\]|\\\\.)+'"
  at <- gregexpr(pattern, whole, perl = TRUE)
  regmatches(whole, at) <- lapply(regmatches(whole, at), blank)
  at <- gregexpr("(?m)^[ \t]*#(?:[^\n]*\\\\\n)*[^\n]*", whole, perl = TRUE)
  regmatches(whole, at) <- lapply(regmatches(whole, at), blank)
  whole
}

type_words <- paste0(
  "^(const|static|double|int|float|char|size_t|unsigned|long|short|struct|enum|union|void|bool|",
  "typedef|extern|inline|uint[0-9]+_t|int[0-9]+_t|SEXP|R_xlen_t|goto|case|",
  "[a-z_0-9]+ +\\*?[a-z_])"
)

c_edits <- function(whole) {
  code <- code_of_c(whole)
  pattern <- paste0(
    "0[xX][0-9a-fA-F.]+([pP][+-]?[0-9]+)?|[0-9]+[.]?[0-9]*([eE][+-]?[0-9]+)?[A-Za-z]*|",
    "[.][0-9]+([eE][+-]?[0-9]+)?|[A-Za-z_][A-Za-z_0-9]*|->|[+][+]|--|&&|[|][|]|<<=?|>>=?|",
    "[-+*/<>=!&|^%]=|[^ \n\t]"
  )
  at <- gregexpr(pattern, code, perl = TRUE)[[1L]]
  from <- as.integer(at)
  to <- from + attr(at, "match.length") - 1L
  token <- substring(code, from, to)
  n <- length(token)
  if (n < 10L) return(list())
  spaced <- substring(code, from - 1L, from - 1L) %in% c(" ", "\n") &
    substring(code, to + 1L, to + 1L) %in% c(" ", "\n")
  before <- c("", token[-n])
  operand <- grepl("^[A-Za-z0-9_.)\\]]", before) & !before %in% c("return", "case")
  # Depth of braces: 0 outside functions. Tables of numbers there are left alone, too.
  depth <- cumsum(token == "{") - cumsum(token == "}")
  # The statement a token stands in: its first token, and whether = came before.
  first <- integer(n)
  assigned <- logical(n)
  start <- 1L
  seen <- FALSE
  nest <- 0L
  in_for <- logical(n)
  for (i in seq_len(n)) {
    if (token[i] %in% c(";", "{", "}")) {
      start <- i + 1L
      seen <- FALSE
    }
    if (token[i] == "=") seen <- TRUE
    first[i] <- start
    assigned[i] <- seen
  }
  # Heads of loops: `for (...)`.
  for (i in which(token == "for")) {
    open <- 0L
    for (j in (i + 1L):n) {
      if (token[j] == "(") open <- open + 1L
      if (token[j] == ")") open <- open - 1L
      in_for[j] <- TRUE
      if (open == 0L) break
    }
  }
  declares <- function(i) {
    statement <- substr(code, from[first[i]], to[i])
    grepl(type_words, statement) &&
      !grepl("^(return|else|if|while|for|do)\\b", statement, perl = TRUE)
  }
  edits <- list()
  add <- function(kind, i, new) {
    edits[[length(edits) + 1L]] <<- edit(kind, from[i], to[i], new)
  }
  for (i in which(depth > 0L)) {
    text <- token[i]
    if (text %in% c("+", "-")) {
      if (operand[i]) {
        if (spaced[i]) add("sign", i, opposite[[text]])
      } else if (text == "-" && !in_for[i]) {
        add("sign", i, " ")
      }
    } else if (text %in% c("+=", "-=") && !in_for[i]) {
      add("sign", i, if (text == "+=") "-=" else "+=")
    } else if (text %in% c("*", "/") && operand[i] && spaced[i]) {
      if (text == "*" && !assigned[i] && declares(i)) next
      add("factor", i, paste(text, 2, text))
    } else if (text %in% c("<", ">", "<=", ">=", "==", "!=") && spaced[i] && !in_for[i]) {
      # How often a long loop looks at Ctrl-C.
      end <- i + match(";", token[i:n], nomatch = 1L) - 1L
      if (grepl("R_CheckUserInterrupt", substr(code, from[i], to[end]))) next
      add("comparison", i, opposite[[text]])
    } else if (text %in% c("&&", "||")) {
      # Of allocations that fail one by one, which no test can make.
      end <- i + match(";", token[i:n], nomatch = 1L) - 1L
      if (!grepl("ROT_ENOMEM", substr(code, from[i], to[end]))) add("logic", i, opposite[[text]])
    } else if (grepl("^[0-9]$", text) && before[i] == "[" && token[i + 1L] == "]" &&
               (assigned[i] || !declares(i))) {
      index <- as.integer(text)
      add("index", i, as.character(if (index > 0L) index - 1L else 1L))
    } else if (text == "DBL_EPSILON" || grepl("^0x1p-[2-9][0-9]$", text) ||
               (grepl("^[0-9.]+[eE]-", text) && is_small(text))) {
      add("allowance", i, paste0("(1000 * ", text, ")"))
    } else if (grepl("^[A-Za-z_]", text) && is_allowance(text) && depth[i] > 0L &&
               !token[i + 1L] %in% c("(", "=", "+=", "*=", "[") && before[i] != "&" &&
               (assigned[i] || !declares(i)) && before[i] != "->" && before[i] != ".") {
      add("allowance", i, paste0("(1000 * ", text, ")"))
    } else if (grepl("^[0-9]*[.][0-9]*([eE][+-]?[0-9]+)?$", text) &&
               suppressWarnings(!as.numeric(text) %in% c(0, NA))) {
      add("factor", i, paste0("(2 * ", text, ")"))
    } else if (grepl("^[A-Za-z_]", text) && i < n && token[i + 1L] == "(" &&
               !text %in% symmetric && !grepl("error|message|fail", text)) {
      open <- 0L
      commas <- integer()
      end <- NA
      for (j in (i + 1L):min(n, i + 400L)) {
        if (token[j] %in% c("(", "[", "{")) open <- open + 1L
        if (token[j] %in% c(")", "]", "}")) open <- open - 1L
        if (token[j] == "," && open == 1L) commas <- c(commas, j)
        if (open == 0L) { end <- j; break }
      }
      if (is.na(end) || !length(commas)) next
      last <- if (length(commas) > 1L) commas[2L] else end
      cut <- function(a, b) substr(whole, from[a], to[b])
      if (commas[1L] == i + 2L || last == commas[1L] + 1L) next
      one <- cut(i + 2L, commas[1L] - 1L)
      two <- cut(commas[1L] + 1L, last - 1L)
      if (one == two || grepl("\"", paste(one, two))) next
      between <- substr(whole, to[commas[1L] - 1L] + 1L, from[commas[1L] + 1L] - 1L)
      edits[[length(edits) + 1L]] <- edit(
        "arguments", from[i + 2L], to[last - 1L], paste0(two, between, one)
      )
    }
  }
  c(edits, c_attitudes(token, from, to, depth))
}

# Functions that return an attitude by a parameter `double q[4]`: inverted at their end.
c_attitudes <- function(token, from, to, depth) {
  edits <- list()
  n <- length(token)
  for (i in which(token == "double" & depth == 0L)) {
    if (i + 4L > n || token[i + 2L] != "[" || token[i + 3L] != "4" || token[i - 1L] == "const") next
    name <- token[i + 1L]
    body <- which(token == "{" & depth == 1L & seq_len(n) > i)[1L]
    end <- which(token == "}" & depth == 0L & seq_len(n) > i)[1L]
    semicolon <- which(token == ";" & depth == 0L & seq_len(n) > i)[1L]
    if (is.na(body) || is.na(end) || (!is.na(semicolon) && semicolon < body)) next
    turned <- sprintf("%s[1] = -%s[1], %s[2] = -%s[2], %s[3] = -%s[3]; ", name, name, name, name,
      name, name)
    returns <- which(token == "return" & seq_len(n) > body & seq_len(n) < end)
    at <- if (length(returns)) utils::tail(returns, 1L) else end
    edits[[length(edits) + 1L]] <- edit("attitude", from[at], to[at], paste0(turned, token[at]))
  }
  edits
}

# Which .c files include a header, directly or through others.
includers_of <- function(folder) {
  files <- list.files(folder, "[.][ch]$", recursive = TRUE)
  includes <- lapply(stats::setNames(files, files), function(file) {
    lines <- grep("^ *# *include *\"", readLines(file.path(folder, file)), value = TRUE)
    names <- sub("^[^\"]*\"([^\"]*)\".*", "\\1", lines)
    ifelse(startsWith(names, "glue/"), names, file.path("core", names))
  })
  headers <- grep("[.]h$", files, value = TRUE)
  reaches <- function(file) {
    known <- character()
    todo <- includes[[file]]
    while (length(todo)) {
      known <- union(known, todo)
      todo <- setdiff(unlist(includes[intersect(todo, files)]), known)
    }
    known
  }
  all <- lapply(includes[grep("[.]c$", files)], function(x) NULL)
  all <- lapply(stats::setNames(nm = grep("[.]c$", files, value = TRUE)), reaches)
  lapply(stats::setNames(nm = headers), function(header) {
    names(all)[vapply(all, function(found) header %in% found, NA)]
  })
}

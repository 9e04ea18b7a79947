return { value = fract(2) }

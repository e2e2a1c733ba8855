COST(shaded, 100)

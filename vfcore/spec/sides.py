def folds_of(request):
    return (request,)
